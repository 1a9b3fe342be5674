#include "io/config/yaml.h"

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

TEST(Yaml, RefusesWhatIsNoYaml) {
  for (const char* bad : {"a: {b", "a: [1", "\t- x: y", "a: b: c", "*x"}) {
    EXPECT_NE(message_of([&] { parse(bad); }), "no InputError") << bad;
  }
  EXPECT_TRUE(parse("").is_map());
  EXPECT_NE(message_of([] { parse("[a]: 1").keys(); }), "no InputError");
}

}  // namespace
}  // namespace walktrack
