#include "io/config/config.h"

#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "io/config/parameters.h"
#include "io/config/presets.h"
#include "io/config/renamed_keys.h"
#include "tests/message_of.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::StartsWith;

std::string message_for_file(const std::string& content) {
  const TemporaryFolder folder;
  const std::string file = folder.write("c.yaml", content);
  ConfigWithOrigin config;
  return message_of<UsageError>([&] { apply_config_file(config, file); });
}

TEST(ConfigFile, NamesLineKeyFoundAndAllowed) {
  EXPECT_THAT(message_for_file("seed: 3\nthreads: -1\n"),
              HasSubstr("c.yaml:2: threads: found '-1', allowed: a whole number from 0 to 4096"));
  EXPECT_THAT(message_for_file("\nthread: 1\n"),
              HasSubstr("c.yaml:2: thread: found an unknown key, did you mean 'threads'?"));
  EXPECT_THAT(message_for_file("seed: [1]\n"), HasSubstr("c.yaml:1: seed: found '[1]'"));
  EXPECT_THAT(message_for_file("seed: {a: 1}\n"), HasSubstr("c.yaml:1: seed: found 'a map'"));
  EXPECT_THAT(message_for_file("seed: 1\nseed: 2\n"),
              HasSubstr("c.yaml:2: seed: found the key twice"));
  EXPECT_THAT(message_for_file("- 1\n"), HasSubstr("found a list, allowed: a map of keys"));
  EXPECT_THAT(message_for_file("seed: {a\n"), HasSubstr("broken YAML"));
  EXPECT_THAT(message_for_file(std::string("seed: {\0", 8)), HasSubstr("bytes that are no text"));
}

TEST(ConfigFile, MayBeInUtf16) {
  const TemporaryFolder folder;
  std::string text = "\xff\xfe";
  for (const char c : std::string("seed: 7\n")) text += {c, '\0'};
  ConfigWithOrigin config;
  apply_config_file(config, folder.write("c.yaml", text));
  EXPECT_EQ(config.values.seed, 7u);
}

// For one release files and --set may use the former name of a key; a message states the new one.
TEST(ConfigFile, TakesTheKeysOfTheLastReleaseAndNamesTheNewOnes) {
  const TemporaryFolder folder;
  ConfigWithOrigin config;
  apply_config_file(config, folder.write("old.yaml", "seed: 1\ngates: {least_steps: 3}\n"));
  apply_setting(config, "motion.misfit=2", "--set");
  EXPECT_EQ(config.values.quality.least_steps, 3);
  EXPECT_EQ(config.values.tracker.motion.residual_scale, 2);
  EXPECT_EQ(config.origin.at("motion.residual_scale"), "--set");
  EXPECT_THAT(config.renamed,
              testing::ElementsAre(
                  testing::EndsWith("old.yaml:2: gates.least_steps is called quality.least_steps "
                                    "now; the next release refuses the old name"),
                  StartsWith("--set: motion.misfit is called motion.residual_scale now")));
  EXPECT_THAT(message_for_file("motion: {misfit: -1}\n"), HasSubstr("motion.misfit: found '-1'"));
}

TEST(ConfigTable, EveryRenamedKeyIsOneOfToday) {
  std::vector<std::string> keys;
  for (const auto& [key, value] : config_values(Config{})) keys.push_back(key);
  for (const RenamedKey& renamed : renamed_keys()) {
    EXPECT_THAT(keys, testing::Contains(renamed.now)) << renamed.before;
    EXPECT_THAT(keys, testing::Not(testing::Contains(renamed.before)));
  }
}

// The seed of the fuzzer should contain every parameter.
TEST(ConfigFile, TheFuzzersSeedStatesEveryKey) {
  ConfigWithOrigin config;
  apply_config_file(config, WALKTRACK_SOURCE_DIR "/tests/fuzz/corpus/config/everything.yaml");
  for (const auto& [key, value] : config_values(config.values))
    EXPECT_TRUE(config.origin.contains(key)) << key;
}

TEST(ConfigFile, MissingKeysAndEmptyFilesMeanDefaults) {
  const TemporaryFolder folder;
  ConfigWithOrigin config;
  apply_config_file(config, folder.write("empty.yaml", "# nothing\n"));
  EXPECT_EQ(config_values(config.values), config_values(Config{}));
  EXPECT_TRUE(config.origin.empty());
}

TEST(ConfigPreset, EveryOneIsAConfigurationAndBalancedIsTheDefault) {
  for (const Preset& preset : presets()) {
    ConfigWithOrigin config;
    apply_config_file(config, std::string(preset.name));
    EXPECT_EQ(config.origin.empty(), preset.name == "balanced") << preset.name;
    for (const auto& [key, origin] : config.origin)
      EXPECT_THAT(origin, StartsWith("preset " + std::string(preset.name) + ":"));
  }
}

// A file of that name takes precedence.
TEST(ConfigPreset, DoesNotHideAFile) {
  const TemporaryFolder folder;
  const std::string file = folder.write("fast", "seed: 99\n");
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  ConfigWithOrigin config;
  apply_config_file(config, "fast");
  fs::current_path(before);
  EXPECT_EQ(config.values.seed, 99u);
  EXPECT_EQ(config.origin.size(), 1u);
}

// A folder of results may have the preset's name.
TEST(ConfigPreset, IsNotHiddenByAFolder) {
  const TemporaryFolder folder;
  fs::create_directory(folder / "fast");
  const fs::path before = fs::current_path();
  fs::current_path(folder.path());
  ConfigWithOrigin config;
  apply_config_file(config, "fast");
  fs::current_path(before);
  EXPECT_FALSE(config.origin.empty());
}

TEST(Config, YamlRoundTripsEveryParameter) {
  const TemporaryFolder folder;
  ConfigWithOrigin config;
  apply_setting(config, "seed=9223372036854775807", "--set");
  const std::string text = config_as_yaml(config, ConfigScope::kEverything, true);
  ConfigWithOrigin back;
  apply_config_file(back, folder.write("c.yaml", text));
  EXPECT_EQ(config_values(back.values), config_values(config.values));
  EXPECT_EQ(config_as_yaml(config, ConfigScope::kChanged, false), "seed: 9223372036854775807\n");
}

TEST(Config, DefaultsLieInTheirRanges) {
  ConfigWithOrigin config;
  for (const auto& [key, value] : config_values(Config{})) {
    EXPECT_NO_THROW(apply_setting(config, key + "=" + value, "default")) << key;
  }
}

TEST(Config, WritesThroughGroupsToTheMembers) {
  const TemporaryFolder folder;
  ConfigWithOrigin config;
  apply_config_file(config, folder.write("c.yaml",
                                         "observation:\n"
                                         "  clip: 2.5\n"
                                         "  flow: {enabled: true, dof: 8}\n"
                                         "  foreground:\n    classes: [0, 1, 1, 2, 0]\n"));
  const ObservationConfig& observation = config.values.observation;
  EXPECT_EQ(observation.clip, 2.5);
  EXPECT_EQ(observation.flow.enabled, TermSetting::kOn);
  EXPECT_EQ(observation.flow.dof, 8);
  EXPECT_EQ(observation.foreground.classes, (std::array{0, 1, 1, 2, 0}));
  EXPECT_EQ(config.origin.at("observation.flow.dof"), "c.yaml:3");
  EXPECT_EQ(config_as_yaml(config, ConfigScope::kChanged, false),
            "observation:  # the likelihood of the images\n  clip: 2.5\n"
            "  foreground:  # the subject's appearance\n    classes: [0, 1, 1, 2, 0]\n"
            "  flow:  # optical flow\n    enabled: on\n    dof: 8\n");
}

TEST(ConfigFile, NamesKeysInsideGroups) {
  EXPECT_THAT(
      message_for_file("error_px: 3\n"),
      HasSubstr("error_px: found an unknown key, did you mean 'observation.flow.error_px'?"));
  EXPECT_THAT(message_for_file("observation:\n  flow:\n    error_pix: 3\n"),
              HasSubstr("c.yaml:3: observation.flow.error_pix: found an unknown key, did you mean "
                        "'observation.flow.error_px'?"));
  EXPECT_THAT(message_for_file("observation: 3\n"), HasSubstr("observation: found an unknown key"));
  EXPECT_THAT(message_for_file("observation: {foreground: {classes: [1, 2]}}\n"),
              HasSubstr("found '[1, 2]', allowed: a list of 5 whole numbers from 0 to 4"));
}

TEST(ConfigFile, RefusesEncoderPresetsThatThereAreNot) {
  EXPECT_THAT(message_for_file("overlay:\n  preset: placebo\n"),
              HasSubstr("c.yaml:2: overlay.preset: found 'placebo', allowed: ultrafast, superfast, "
                        "veryfast, faster, fast, medium"));
  EXPECT_THAT(message_for_file("overlay: {width: -1}\n"),
              HasSubstr("overlay.width: found '-1', allowed: a whole number from 0 to 8192"));
}

TEST(Parameters, TextBecomesAValueOnlyWithinItsRange) {
  double number = -1;
  EXPECT_TRUE(number_in_range("2.5e-1", 0, 1, number));
  EXPECT_EQ(number, 0.25);
  for (const char* bad : {"1.5", "-0.1", "nan", "inf", "", "0.1x", "0,1"}) {
    EXPECT_FALSE(number_in_range(bad, 0, 1, number)) << bad;
  }
  int64_t whole = -1;
  EXPECT_TRUE(integer_in_range("10", 1, 10, whole));
  for (const char* bad : {"0", "11", "1.0", "1e1", "", " 5", "99999999999999999999"}) {
    EXPECT_FALSE(integer_in_range(bad, 1, 10, whole)) << bad;
  }
  bool flag = true;
  EXPECT_TRUE(flag_from_text("false", flag));
  EXPECT_FALSE(flag);
  EXPECT_FALSE(flag_from_text("no", flag));
  std::vector<double> values;
  EXPECT_TRUE(list_in_range("[1, 2.5]", 2, false, 0, 3, values));
  EXPECT_EQ(values, (std::vector<double>{1, 2.5}));
  for (const char* bad : {"[1, 2.5]", "[1]", "1, 2", "[1, 2,]", "[1, 4]", "[]", "[", ""}) {
    values.clear();
    EXPECT_FALSE(list_in_range(bad, 2, true, 0, 3, values)) << bad;
  }
}

}  // namespace
}  // namespace walktrack
