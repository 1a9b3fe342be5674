#include "io/config/yaml.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "tests/message_of.h"

namespace walktrack {
namespace {

YamlValue parse(const std::string& text) { return YamlValue::from_text(text, "f.yaml"); }

TEST(Yaml, ReadsTypedValues) {
  const YamlValue root = parse("a: 1.5\nb: [1, 2]\nc: {d: word}\ne: 7\n");
  EXPECT_EQ(root.at("a").number(0, 2), 1.5);
  EXPECT_EQ(root.at("b").numbers(2), (std::vector<double>{1, 2}));
  EXPECT_EQ(root.at("c").at("d").text(), "word");
  EXPECT_EQ(root.at("e").integer(0, 10), 7);
  EXPECT_TRUE(root.has("a"));
  EXPECT_FALSE(root.has("z"));
  EXPECT_FALSE(parse("a:\n").has("a"));
}

// As of a table that is given in place of a scene.
TEST(Yaml, ShowsTheBeginningOfALongWord) {
  const auto found = [](const std::string& word) {
    return message_of([&] { parse(word).keys(); });
  };
  const std::string quoted = "found '" + std::string(78, 'x');
  EXPECT_THAT(found(std::string(78, 'x')), testing::HasSubstr(quoted + "', allowed"));
  EXPECT_THAT(found(std::string(5000, 'x')), testing::HasSubstr(quoted + "x..., allowed"));
  // The letter of two bytes would be cut.
  EXPECT_THAT(found(std::string(78, 'x') + "\u00e9" + std::string(9, 'x')),
              testing::HasSubstr(quoted + "..., allowed"));
}

TEST(Yaml, NamesPlaceFoundAndAllowed) {
  const YamlValue root = parse("a: 3\nb:\n  c: [1, x]\n  d: {}\n");
  const std::vector<std::pair<std::function<void()>, std::string>> cases{
      {[&] { root.at("a").number(0, 2); }, "f.yaml:1: a: found '3', allowed: a number from 0 to 2"},
      {[&] { root.at("b").at("c").numbers(); }, "f.yaml:3: b.c[1]: found 'x', allowed: a number"},
      {[&] { root.at("b").at("c").numbers(3); }, "f.yaml:3: b.c[1]: found 'x', allowed: a number"},
      {[&] { root.at("b").at("d").text(); }, "f.yaml:4: b.d: found a map, allowed: a word or text"},
      {[&] { root.at("b").at("d").items(); }, "f.yaml:4: b.d: found a map, allowed: a list"},
      {[&] { root.at("b").at("e"); },
       "f.yaml:3: b.e: found nothing, allowed: this key is required"},
      {[&] { root.at("a").integer(4, 5); },
       "f.yaml:1: a: found '3', allowed: a whole number from 4 to 5"},
      {[&] { root.at("a").keys(); }, "f.yaml:1: a: found '3', allowed: a map of keys"},
      {[&] {
         parse("b:\n  spead: 1").at("b").only_keys({"time", "speed"});
       },
       "f.yaml:2: b.spead: found an unknown key, did you mean 'speed'?, allowed: time, speed"},
      {[&] { parse("x: 1\nx: 2").only_keys({"x"}); },
       "f.yaml:2: x: found the key twice, allowed: once"},
  };
  for (const auto& [call, expected] : cases) EXPECT_EQ(message_of(call), expected);
}

// The parser itself would silently take one of the two.
TEST(Yaml, RefusesKeysTwiceWhereverTheyStand) {
  const auto message = [](const char* text) { return message_of([&] { parse(text); }); };
  EXPECT_EQ(message("a: 1\nb: 2\na: 3\n"), "f.yaml:3: a: found the key twice, allowed: once");
  EXPECT_EQ(message("a:\n  - {x: 1}\n  - x: 1\n    y: {z: 1, z: 2}\n"),
            "f.yaml:4: a[1].y.z: found the key twice, allowed: once");
  EXPECT_EQ(message("a: {b: 1}\nc: [{b: 1}, {b: 2}]\nd: {a: [1], e: {a: 2}, c: }\n"), "");
  EXPECT_EQ(message("a: &x {b: 1}\nc: *x\nd: [*x, *x]\n"), "");
}

TEST(Yaml, RefusesASecondDocument) {
  EXPECT_EQ(message_of([] { parse("a: 1\n---\na: 2\n"); }),
            "f.yaml:2: found a second YAML document, allowed: one a file");
  for (const char* one : {"---\na: 1\n", "%YAML:1.0\n---\na: 1\n", "a: 1\n...\n", "# a\n"})
    EXPECT_EQ(message_of([&] { parse(one); }), "") << one;
}

TEST(Yaml, RefusesWhatIsNoYaml) {
  for (const char* bad : {"a: {b", "a: [1", "\t- x: y", "a: b: c", "*x"}) {
    EXPECT_NE(message_of([&] { parse(bad); }), "") << bad;
  }
  EXPECT_TRUE(parse("").is_map());
  EXPECT_NE(message_of([] { parse("[a]: 1").keys(); }), "");
}

}  // namespace
}  // namespace walktrack
