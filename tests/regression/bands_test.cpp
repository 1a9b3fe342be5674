#include "tests/regression/bands.h"

#include <cmath>
#include <limits>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
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

// Runs with one value.
std::vector<FigureValues> runs_of(const std::string& key, const std::vector<double>& values) {
  std::vector<FigureValues> out;
  for (const double value : values) out.push_back({{key, value}});
  return out;
}

TEST(Bands, AreTheMedianAShareOfItAndThreeDeviationsOfTheInnerSeeds) {
  // Inner range 1.8646: deviation 1.
  const auto runs =
      runs_of("joint_error_mean_mm", {20, 19, 19.2, 20.8646, 20.3, 300, 0, 20.5, 19.8});
  const Band found = band(bands_from({{"scene", runs}}), "joint_error_mean_mm");
  EXPECT_EQ(found.median, 20);
  EXPECT_NEAR(found.high, 20 + 0.15 * 20 + 3, 1e-9);
  EXPECT_EQ(found.low, 0);
  EXPECT_EQ(found.best, 20);
}

TEST(Bands, HoldWhatTheFirstSeedsSayEvenIfTwoOfThemAreOdd) {
  const auto runs = runs_of("joint_error_mean_mm", {300, 280, 70, 71, 72, 73, 70, 71, 72});
  const std::vector<Band> bands = bands_from({{"scene", runs}});
  EXPECT_THAT(out_of_bands(bands, "scene", {runs.begin(), runs.begin() + 3}), IsEmpty());
}

TEST(Bands, HoldNothingThatHasDoubledHoweverMuchSeedsDiffer) {
  const auto runs = runs_of("joint_error_mean_mm", {20, 21, 19, 35, 10, 12, 33, 37, 20});
  const std::vector<Band> bands = bands_from({{"scene", runs}});
  EXPECT_NEAR(bands.front().high, 1.9 * 20, 1e-9);
}

TEST(Bands, ThatNothingCanLeaveAreNone) {
  const auto now_and_then = runs_of("swapped_percent", {0, 100, 0, 100, 50, 100, 0, 100, 0});
  EXPECT_THAT(bands_from({{"scene", now_and_then}}), IsEmpty());
  const auto nearly_never = runs_of("swapped_percent", {0, 2, 0, 1, 0, 0, 0, 0, 0});
  EXPECT_THAT(bands_from({{"scene", nearly_never}}), SizeIs(1));
}

// One seed in nine gives no evidence of the others.
TEST(Bands, AreNoWiderForOneOddSeed) {
  const auto runs = runs_of("joint_error_mean_mm", {300, 72, 70, 71, 72, 73, 70, 71, 72});
  const std::vector<Band> bands = bands_from({{"scene", runs}});
  EXPECT_LT(bands.front().high, 90);
  EXPECT_THAT(out_of_bands(bands, "scene", {runs[0]}), SizeIs(1));
}

TEST(Bands, AnImprovementNeverLeavesThem) {
  const std::vector<FigureValues> runs(
      kBandSeeds, {{"joint_error_mean_mm", 60}, {"filled_percent", 90}, {"offset_along_mm", -50}});
  const std::vector<Band> bands = bands_from({{"scene", runs}});
  const auto with = [&](double error, double filled, double offset) {
    return out_of_bands(bands, "scene",
                        {{{"joint_error_mean_mm", error},
                          {"filled_percent", filled},
                          {"offset_along_mm", offset}}});
  };
  EXPECT_THAT(with(0, 100, 0), IsEmpty());
  EXPECT_THAT(with(70, 90, 0), SizeIs(1));
  EXPECT_THAT(with(0, 85, 0), SizeIs(1));
  EXPECT_THAT(with(0, 90, -61), SizeIs(1));
  EXPECT_THAT(with(0, 90, 11), SizeIs(1));
}

TEST(Bands, CoverageWidthsAndEvidenceAreHeldFromBothSides) {
  const std::vector<FigureValues> runs(
      kBandSeeds, {{"coverage90_percent", 80}, {"interval_width_mm", 100}, {"log_evidence", 200}});
  const std::vector<Band> bands = bands_from({{"scene", runs}});
  const auto with = [&](double coverage, double width, double evidence) {
    return out_of_bands(bands, "scene",
                        {{{"coverage90_percent", coverage},
                          {"interval_width_mm", width},
                          {"log_evidence", evidence}}});
  };
  EXPECT_THAT(with(80, 100, 200), IsEmpty());
  EXPECT_THAT(with(99, 1000, 400), SizeIs(3));
  EXPECT_THAT(with(70, 50, 100), SizeIs(3));
}

TEST(Bands, EndWhereAFigureCannotBe) {
  const auto swapped = runs_of("swapped_percent", {6, 9, 7, 3, 9, 8, 9, 2, 8});
  EXPECT_EQ(band(bands_from({{"scene", swapped}}), "swapped_percent").low, 0);
  const auto inside = runs_of("coverage90_percent", {96, 99, 97, 93, 99, 98, 99, 92, 98});
  EXPECT_EQ(band(bands_from({{"scene", inside}}), "coverage90_percent").high, 100);
}

TEST(Bands, SharesOfTheMedianStaySmall) {
  for (const WatchedFigure& figure : watched_figures())
    EXPECT_LE(figure.share, kLargestShare) << figure.key;
}

// Small steps for the worse, each within the band of the one before.
TEST(Bands, WhatGetsWorseStepByStepHasToBeExcused) {
  std::vector<Band> bands;
  for (const double error : {60.0, 66.0, 74.0, 82.0}) {
    const std::vector<FigureValues> runs(kBandSeeds, {{"joint_error_mean_mm", error}});
    bands = with_best(bands_from({{"scene", runs}}), bands);
  }
  EXPECT_EQ(bands.front().best, 60);
  EXPECT_THAT(unexcused(bands, {}), SizeIs(1));
  const Excuse excuse{"scene", "joint_error_mean_mm"};
  EXPECT_THAT(unexcused(bands, {excuse}), IsEmpty());
  bands.front().median = 61;
  EXPECT_THAT(unexcused(bands, {excuse}), SizeIs(1)) << "no need for the excuse";
}

TEST(Bands, AnExcuseHasAReason) {
  const TemporaryFolder folder;
  EXPECT_THAT(read_excuses(folder.write("worse.csv", "scene,figure,why\na,b,light\n")), SizeIs(1));
  EXPECT_THROW(read_excuses(folder.write("worse.csv", "scene,figure,why\na,b,\n")), InputError);
}

TEST(Bands, AFigureThatIsGoneIsNotInItsBand) {
  const std::vector<FigureValues> runs(kBandSeeds, {{"filled_percent", 100}});
  const std::vector<Band> bands = bands_from({{"scene", runs}});
  EXPECT_THAT(out_of_bands(bands, "scene", {{}}), SizeIs(1));
  EXPECT_THAT(out_of_bands(bands, "scene", {{{"filled_percent", kNan}}}), SizeIs(1));
  EXPECT_THAT(out_of_bands(bands, "another", {{}}), IsEmpty());
}

TEST(Bands, AFigureThatOneSeedLacksHasNone) {
  EXPECT_THAT(bands_from({{"a", runs_of("filled_percent", {1, 1, 1, kNan, 1, 1, 1, 1, 1})}}),
              IsEmpty());
}

TEST(Bands, SurviveTheirFile) {
  const TemporaryFolder folder;
  std::vector<FigureValues> runs =
      runs_of("joint_error_mean_mm", {60, 70, 65, 61, 62, 63, 64, 66, 67});
  for (FigureValues& run : runs) run["offset_along_mm"] = -0.3 * run.at("joint_error_mean_mm");
  const std::string text = bands_csv(bands_from({{"a", runs}, {"b", runs}}));
  EXPECT_EQ(bands_csv(read_bands(folder.write("bands.csv", text))), text);
}

TEST(Bands, AreWrittenOutwards) {
  const TemporaryFolder folder;
  const auto written = [&](const Band& band) {
    return read_bands(folder.write("bands.csv", bands_csv({band}))).front();
  };
  const Band read = written({"scene", "offset_along_mm", -15.154, 20, 15.151, 20});
  const Band again = written(read);
  EXPECT_EQ(read.low, -15.16);
  EXPECT_EQ(read.high, 15.16);
  EXPECT_EQ(again.low, read.low);
  EXPECT_EQ(again.high, read.high);
}

TEST(Bands, TheDifferenceNamesWhatChangedAndWhatLeftItsBand) {
  const Band error{"a", "error", 0, 50, 60, 50}, gone{"a", "gone", 0, 1, 2, 1};
  Band little = error, much = error;
  little.median = 55;
  much.median = 70;
  much.high = 80;
  EXPECT_EQ(bands_difference({error}, {error}), "No band has changed.\n");
  EXPECT_THAT(bands_difference({error}, {little}),
              testing::AllOf(HasSubstr("| a | error | 50 [0, 60] | 55 [0, 60] |"),
                             Not(HasSubstr("outside"))));
  EXPECT_THAT(bands_difference({error}, {much}), HasSubstr("**outside the old band**"));
  EXPECT_THAT(bands_difference({error, gone}, {error}), HasSubstr("| - | gone |"));
  EXPECT_THAT(bands_difference({}, {error}), HasSubstr("| new |"));
}

}  // namespace
}  // namespace walktrack
