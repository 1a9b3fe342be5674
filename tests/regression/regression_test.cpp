// The scenes of the suite compared with the bands in the repository. The fast subset is part of
// every test run, the whole suite of `ctest -L slow`.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/regression/compared.h"

namespace walktrack {
namespace {

constexpr const char* kHelp =
    "if this is meant: scripts/refresh_bands.sh, and let its table be reviewed";

class FastRegression : public testing::TestWithParam<SuiteScene> {};
class FullRegression : public testing::TestWithParam<SuiteScene> {};

void expect_in_bands(std::string_view name) {
  const auto left =
      out_of_bands(read_bands(bands_file()), std::string(name), values_of(compared_results(name)));
  EXPECT_THAT(left, testing::IsEmpty()) << kHelp;
}

void expect_in_bands(const SuiteScene& scene) {
  if (!is_there(scene)) GTEST_SKIP() << "no ../shared/data/" << scene.clip->scene;
  expect_in_bands(scene.name);
}

TEST_P(FastRegression, StaysInItsBands) { expect_in_bands(GetParam()); }
TEST_P(FullRegression, StaysInItsBands) { expect_in_bands(GetParam()); }

std::vector<SuiteScene> fast_scenes() {
  std::vector<SuiteScene> out;
  for (const SuiteScene& scene : suite_scenes())
    if (scene.fast) out.push_back(scene);
  return out;
}

std::string name_of(const testing::TestParamInfo<SuiteScene>& info) {
  return std::string(info.param.name);
}

INSTANTIATE_TEST_SUITE_P(Suite, FastRegression, testing::ValuesIn(fast_scenes()), name_of);
INSTANTIATE_TEST_SUITE_P(Suite, FullRegression,
                         testing::ValuesIn(suite_scenes().begin(), suite_scenes().end()), name_of);

TEST(Regression, EverySceneHasBands) {
  const std::vector<Band> bands = read_bands(bands_file());
  for (const SuiteScene& scene : suite_scenes()) {
    const auto of_scene = [&](const Band& band) { return band.scene == scene.name; };
    // A figure may be lacking, e.g. the slide of a foot that never stands; most must not.
    const int least = !scene.clip ? 20 : scene.clip->truth.empty() ? 2 : 7;
    EXPECT_GE(std::count_if(bands.begin(), bands.end(), of_scene), least) << scene.name;
  }
}

TEST(Regression, WhatIsWorseThanItWasIsExplained) {
  EXPECT_THAT(unexcused(read_bands(bands_file()), read_excuses(excuses_file())),
              testing::IsEmpty());
}

// A band that contains twice the usual error is useless.
TEST(Regression, ErrorsAndWidthsThatDoubleLeaveTheirBands) {
  for (const Band& band : read_bands(bands_file())) {
    const auto of = [&](const WatchedFigure& figure) { return figure.key == band.key; };
    const auto figure = std::ranges::find_if(watched_figures(), of);
    if (figure == watched_figures().end() || figure->most_growth > kNotDoubled) continue;
    EXPECT_LT(band.high, 2 * band.median) << band.scene << " " << band.key;
  }
}

TEST(Regression, NoBandReachesBeyondWhatIsPossible) {
  for (const Band& band : read_bands(bands_file())) {
    for (const WatchedFigure& figure : watched_figures()) {
      if (figure.key != band.key) continue;
      EXPECT_GE(band.low, figure.least) << band.scene << " " << band.key;
      EXPECT_LE(band.high, figure.most) << band.scene << " " << band.key;
      EXPECT_LE(figure.share, kLargestShare);
    }
  }
}

}  // namespace
}  // namespace walktrack
