// The manual page and the completion, which are generated from the program's own declarations.
#include <cstdlib>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/run_program.h"

namespace walktrack {
namespace {

using testing::HasSubstr;
using testing::Not;

std::vector<std::string> lines(const std::string& text) {
  std::vector<std::string> out;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) out.push_back(line);
  return out;
}

TEST(Manual, HasEveryCommandWithItsOptionsAndExample) {
  const std::string page = run_walktrack({"--help-man"}).out;
  for (const std::string& word : lines(run_walktrack({"--help-words"}).out)) {
    if (word.starts_with("--")) continue;
    EXPECT_THAT(page, HasSubstr(".SS walktrack " + word));
    EXPECT_THAT(page, HasSubstr("\nwalktrack " + word)) << "its example";
  }
  EXPECT_THAT(page, HasSubstr("\\fB\\-j, \\-\\-jobs\\fR \\fIN"));
  EXPECT_THAT(page, HasSubstr("\\fB\\-o, \\-\\-output\\fR \\fIPATH"));
  EXPECT_THAT(page, HasSubstr(".SH EXIT STATUS"));
}

// A line that begins with a point or a quote is a request; only those of man(7) may occur.
TEST(Manual, HasNoRequestsByAccident) {
  for (const std::string& line : lines(run_walktrack({"--help-man"}).out)) {
    if (!line.starts_with(".") && !line.starts_with("'")) continue;
    const std::string request = line.substr(0, line.find(' '));
    EXPECT_THAT((std::vector<std::string>{".TH", ".SH", ".SS", ".TP", ".PP", ".RS", ".RE", ".nf",
                                          ".fi", ".B", ".I"}),
                testing::Contains(request));
  }
}

// The completions after these words, the last of which is being typed.
std::vector<std::string> offered(const std::string& words, int at) {
  const std::string script = "set -u; compopt() { :; }; source '" WALKTRACK_SOURCE_DIR
                             "/apps/completion.bash'; "
                             "walktrack() { '" WALKTRACK_BINARY "' \"$@\"; }; COMP_WORDS=(" +
                             words + "); COMP_CWORD=" + std::to_string(at) +
                             "; _walktrack; printf '%s\\n' \"${COMPREPLY[@]}\"";
  return lines(run_program("/bin/bash", {"-c", script}).out);
}

TEST(Completion, OffersCommandsOptionsAndParameters) {
  EXPECT_THAT(offered("walktrack tra", 1), testing::ElementsAre("track"));
  EXPECT_THAT(offered("walktrack ''", 1), testing::Contains("batch"));
  EXPECT_THAT(offered("walktrack batch --jo", 2), testing::ElementsAre("--jobs"));
  EXPECT_THAT(offered("walktrack track --se", 2), testing::ElementsAre("--set", "--seed"));
  EXPECT_THAT(offered("walktrack track --set filter.par", 3),
              testing::ElementsAre("filter.particles="));
}

TEST(Config, NamesItsKeys) {
  const auto keys = lines(run_walktrack({"config", "--keys"}).out);
  EXPECT_THAT(keys, testing::Contains("filter.particles"));
  EXPECT_THAT(keys, testing::Each(Not(HasSubstr(" "))));
}

TEST(Check, PrintsJsonForPrograms) {
  const ProgramResult result =
      run_walktrack({"check", WALKTRACK_SOURCE_DIR "/data/demo/scene.yaml", "--json"});
  EXPECT_EQ(result.exit_code, 0) << result.err;
  EXPECT_THAT(result.out, testing::StartsWith("{\n  \"sound\": true,"));
  EXPECT_THAT(result.out, HasSubstr("\"centre_m\""));
}

}  // namespace
}  // namespace walktrack
