// The output on a terminal, and the output into a file.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/run_program.h"

namespace walktrack {
namespace {

using testing::ContainsRegex;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;

constexpr char kEscape[] = "\033", kAnyColour[] = "\033\\[[0-9;]*m";

class TerminalTest : public testing::Test {
 protected:
  // `env SETTING walktrack simulate ...`: a job that takes a few tenths of a second.
  std::vector<std::string> words(const std::string& setting) const {
    return {setting, WALKTRACK_BINARY, "simulate", "--model",      "kneed", "--duration",
            "20",    "--no-pictures",  "-o",       folder_ / "out"};
  }
  std::string seen_with(const std::string& setting, bool quiet = false) const {
    std::vector<std::string> all = words(setting);
    if (quiet) all.push_back("--quiet");
    const ProgramResult result = run_on_terminal("/usr/bin/env", all);
    EXPECT_EQ(result.exit_code, 0) << result.err;
    return result.err;
  }
  const TemporaryFolder folder_;
};

TEST_F(TerminalTest, ShowsProgressInColourWithThePaceAndWhatIsLeft) {
  const std::string seen = seen_with("NO_COLOR=");  // set but empty counts as not set
  EXPECT_THAT(seen, HasSubstr("simulating [\033[32m"));
  EXPECT_THAT(seen, ContainsRegex("/20000  [0-9]+\\.[0-9]/s  [0-9]+ s left"));
  EXPECT_THAT(seen, HasSubstr("walktrack: kneed: "));
}

TEST_F(TerminalTest, NoColourTakesAwayTheColourAlone) {
  const std::string seen = seen_with("NO_COLOR=1");
  EXPECT_THAT(seen, HasSubstr("simulating [="));
  EXPECT_THAT(seen, Not(ContainsRegex(kAnyColour)));
}

TEST_F(TerminalTest, QuietMeansNothingAtAll) {
  EXPECT_THAT(seen_with("NO_COLOR=", true), IsEmpty());
}

TEST_F(TerminalTest, AFileGetsMessagesWithoutProgressOrEscapes) {
  const ProgramResult result = run_program("/usr/bin/env", words("NO_COLOR="));
  EXPECT_EQ(result.exit_code, 0);
  EXPECT_THAT(result.err, HasSubstr("walktrack: kneed: "));
  EXPECT_THAT(result.err, Not(HasSubstr("simulating")));
  EXPECT_THAT(result.out + result.err, Not(HasSubstr(kEscape)));
}

}  // namespace
}  // namespace walktrack
