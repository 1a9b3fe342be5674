#include "tests/regression/bands.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/run_program.h"

namespace walktrack {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::SizeIs;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

const Band& band(const std::vector<Band>& bands, const std::string& key) {
  for (const Band& each : bands)
    if (each.key == key) return each;
  throw std::out_of_range(key);
}

// Seven runs with one figure.
std::vector<FigureValues> runs_of(const std::string& key, const std::vector<double>& values) {
  std::vector<FigureValues> out;
  for (const double value : values) out.push_back({{key, value}});
  return out;
}

TEST(Bands, AreTheMedianTheFloorAndTwoDeviationsOfTheInnerSeeds) {
  // Inner range 1.5148: deviation 1.
  const auto runs = runs_of("joint_error_mean_mm", {11, 10, 10.2, 11.5148, 11.3, 300, 0});
  const Band found = band(bands_from({{"scene", runs}}), "joint_error_mean_mm");
  EXPECT_EQ(found.median, 11);
  EXPECT_NEAR(found.high, 11 + 15 + 2, 1e-9);
  EXPECT_EQ(found.low, -std::numeric_limits<double>::infinity());
}

TEST(Bands, HoldWhatTheFirstSeedsSayEvenIfTwoOfThemAreOdd) {
  const auto runs = runs_of("joint_error_mean_mm", {300, 280, 70, 71, 72, 73, 70});
  const std::vector<Band> bands = bands_from({{"scene", runs}});
  EXPECT_THAT(out_of_bands(bands, "scene", {runs.begin(), runs.begin() + 3}), IsEmpty());
  EXPECT_THAT(out_of_bands(bands, "scene", {runs[0]}), IsEmpty());  // within the floor of 280
}

TEST(Bands, AnImprovementNeverLeavesThem) {
  const std::vector<FigureValues> runs(
      kBandSeeds,
      {{"joint_error_mean_mm", 60}, {"coverage90_percent", 40}, {"offset_along_mm", -50}});
  const std::vector<Band> bands = bands_from({{"scene", runs}});
  const auto with = [&](double error, double coverage, double offset) {
    return out_of_bands(bands, "scene",
                        {{{"joint_error_mean_mm", error},
                          {"coverage90_percent", coverage},
                          {"offset_along_mm", offset}}});
  };
  EXPECT_THAT(with(0, 90, 0), IsEmpty());
  EXPECT_THAT(with(76, 90, 0), SizeIs(1));
  EXPECT_THAT(with(0, 37, 0), SizeIs(1));
  EXPECT_THAT(with(0, 90, -61), SizeIs(1));
  EXPECT_THAT(with(0, 90, 11), SizeIs(1));
}

TEST(Bands, AFigureThatIsGoneIsNotInItsBand) {
  const std::vector<FigureValues> runs(kBandSeeds, {{"filled_percent", 100}});
  const std::vector<Band> bands = bands_from({{"scene", runs}});
  EXPECT_THAT(out_of_bands(bands, "scene", {{}}), SizeIs(1));
  EXPECT_THAT(out_of_bands(bands, "scene", {{{"filled_percent", kNan}}}), SizeIs(1));
  EXPECT_THAT(out_of_bands(bands, "another", {{}}), IsEmpty());
}

TEST(Bands, AFigureThatOneSeedLacksHasNone) {
  EXPECT_THAT(bands_from({{"a", runs_of("filled_percent", {1, 1, 1, kNan, 1, 1, 1})}}), IsEmpty());
}

TEST(Bands, SurviveTheirFile) {
  const TemporaryFolder folder;
  std::vector<FigureValues> runs = runs_of("joint_error_mean_mm", {60, 70, 65, 61, 62, 63, 64});
  for (FigureValues& run : runs) run["offset_along_mm"] = -0.3 * run.at("joint_error_mean_mm");
  const std::string text = bands_csv(bands_from({{"a", runs}, {"b", runs}}));
  EXPECT_EQ(bands_csv(read_bands(folder.write("bands.csv", text))), text);
}

TEST(Bands, TheDifferenceNamesWhatChangedAndWhatLeftItsBand) {
  const Band error{"a", "error", 0, 50, 60}, gone{"a", "gone", 0, 1, 2};
  Band little = error, much = error;
  little.median = 55;
  much.median = 70;
  much.high = 80;
  EXPECT_EQ(bands_difference({error}, {error}), "No band has changed.\n");
  EXPECT_THAT(bands_difference({error}, {little}),
              testing::AllOf(HasSubstr("| a | error | 50.00 [0.00, 60.00] | 55.00 [0.00, 60.00] |"),
                             Not(HasSubstr("outside"))));
  EXPECT_THAT(bands_difference({error}, {much}), HasSubstr("**outside the old band**"));
  EXPECT_THAT(bands_difference({error, gone}, {error}), HasSubstr("| - | gone |"));
  EXPECT_THAT(bands_difference({}, {error}), HasSubstr("| new |"));
}

}  // namespace
}  // namespace walktrack
