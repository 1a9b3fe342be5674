#include "core/errors.h"

#include <gtest/gtest.h>

namespace walktrack {
namespace {

TEST(Describe, NamesPlaceFoundAndAllowed) {
  EXPECT_EQ(describe({"scene.yaml", 7, "cameras[0].video"}, "'3'", "a file"),
            "scene.yaml:7: cameras[0].video: found '3', allowed: a file");
}

TEST(Describe, LeavesOutWhatIsUnknown) {
  EXPECT_EQ(describe({"", 0, "threads"}, "'x'", ""), "threads: found 'x'");
  EXPECT_EQ(describe({"a.csv", 0, ""}, "no rows", ""), "a.csv: found no rows");
}

TEST(Describe, IsOneLineThatDoesNothingToATerminal) {
  EXPECT_EQ(describe({"a\nb.yaml", 3, "k\t"}, "'\x1b[2J\x7f'", "\xC3\xBC"),
            "a b.yaml:3: k : found ' [2J ', allowed: \xC3\xBC");
}

TEST(NearestWord, FindsATypoAndRefusesAStranger) {
  const std::vector<std::string> keys{"particles", "seed", "flow"};
  EXPECT_EQ(nearest_word("particels", keys), "particles");
  EXPECT_EQ(nearest_word("sed", keys), "seed");
  EXPECT_EQ(nearest_word("vidoe", {"name", "video"}), "video");  // one edit, no more are allowed
  EXPECT_EQ(nearest_word("background", keys), "");
  EXPECT_EQ(nearest_word("", {}), "");
  // At the limit: two letters more than six, of which two may differ.
  EXPECT_EQ(nearest_word("speeds", {"speedsxx"}), "speedsxx");
  EXPECT_EQ(nearest_word("speeds", {"speedsxxx"}), "");
}

// Each letter of the word times each of the candidate would be 1e10 steps, half a minute.
TEST(NearestWord, OfAMegabyteComesAtOnce) {
  EXPECT_EQ(nearest_word(std::string(1 << 20, 'x'), {std::string(10'000, 'x')}), "");
}

}  // namespace
}  // namespace walktrack
