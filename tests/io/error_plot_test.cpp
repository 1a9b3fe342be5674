#include "io/drawing/error_plot.h"

#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/io/times_found.h"

namespace walktrack {
namespace {

using testing::HasSubstr;
using testing::Not;

ErrorSeries series(const std::string& name, std::vector<double> errors) {
  ErrorSeries out{name, {}, std::move(errors), {}, {}};
  for (size_t i = 0; i < out.error_mm.size(); ++i) out.time.push_back(0.5 * static_cast<double>(i));
  out.joint_mm.fill(std::nan(""));
  out.joint_mm[static_cast<size_t>(Joint::kLeftKnee)] = 25;
  return out;
}

TEST(ErrorPlot, HasACurveABarAndANameForEachEstimate) {
  const std::string svg =
      error_plot_svg("truth", {series("first", {10, 20, 30}), series("a < b & c", {5, 5, 5})});
  EXPECT_EQ(times_found(svg, "<path"), 2u);
  EXPECT_THAT(svg, HasSubstr(">first<"));
  EXPECT_THAT(svg, HasSubstr("a &lt; b &amp; c"));
  EXPECT_THAT(svg, HasSubstr(">lknee<"));
  EXPECT_THAT(svg, Not(HasSubstr(">head<")));           // never known
  EXPECT_EQ(times_found(svg, "fill=\"#0072b2\""), 2u);  // in the legend and as a bar
  EXPECT_EQ(times_found(svg, "http"), 1u);              // the name space; nothing is fetched
}

// The panel is 220 px high from 102 px on: 30 mm are three of its four ticks of 10 mm; time extends
// from 60 to 880 px.
TEST(ErrorPlot, DrawsErrorsToScaleFromZeroUp) {
  const std::string svg = error_plot_svg("truth", {series("first", {0, 40, 20})});
  EXPECT_THAT(svg, HasSubstr("d=\"M60.0 302.0L470.0 82.0L880.0 192.0\""));
}

TEST(ErrorPlot, BreaksTheCurveWhereNobodyWasFound) {
  const std::string svg = error_plot_svg("truth", {series("first", {10, std::nan(""), 20, 20})});
  const size_t path = svg.find("<path");
  EXPECT_EQ(times_found(svg.substr(path, svg.find("/>", path) - path), "M"), 2u);
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
}

// The reliability diagram is a square of 220 px from 60 px on: intervals that hold what they should
// lie on its diagonal, those that hold half of it below it.
TEST(ErrorPlot, ShowsHowOftenIntervalsHoldTheTruth) {
  ErrorSeries calibrated = series("calibrated", {10, 20}), narrow = series("narrow", {10, 20});
  const ErrorSeries without = series("no intervals", {10, 20});
  calibrated.coverage.emplace();
  calibrated.coverage->share_of_level = kIntervalLevels;
  narrow.coverage.emplace();
  for (size_t k = 0; k < kIntervalLevels.size(); ++k)
    narrow.coverage->share_of_level[k] = 0.5 * kIntervalLevels[k];
  EXPECT_THAT(error_plot_svg("truth", {without}), Not(HasSubstr("truth inside the interval")));
  const std::string svg = error_plot_svg("truth", {without, calibrated, narrow});
  EXPECT_THAT(svg, HasSubstr("truth inside the interval, %"));
  const auto height_at = [&](const std::string& x) {  // of each line that has a point there
    std::vector<double> out;
    for (size_t at = svg.find("L" + x + " "); at != std::string::npos;
         at = svg.find("L" + x + " ", at + 1))
      out.push_back(std::stod(svg.substr(at + x.size() + 2)));
    return out;
  };
  const std::vector<double> corner = height_at("280.0"), half = height_at("170.0");
  ASSERT_EQ(corner.size(), 3u);  // the diagonal and two estimates
  ASSERT_EQ(half.size(), 2u);
  EXPECT_NEAR(half[0], corner[0] + 110, 0.11);
  EXPECT_NEAR(half[1], corner[0] + 165, 0.11);
}

TEST(ErrorPlot, NothingKnownIsAnEmptyPicture) {
  const std::string svg = error_plot_svg("truth", {series("first", {})});
  EXPECT_THAT(svg, HasSubstr("</svg>"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

}  // namespace
}  // namespace walktrack
