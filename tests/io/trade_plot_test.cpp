#include "io/drawing/trade_plot.h"

#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/io/times_found.h"

namespace walktrack {
namespace {

using testing::HasSubstr;
using testing::Not;

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

TEST(TradePlot, MarksEverySettingAndNamesTheFront) {
  const std::string svg = trade_plot_svg("scene <1>", "error, mm",
                                         {{"a&b", 10, 40, 5, true, true},
                                          {"slow", 5, 60, kNone, true, false},
                                          {"gone", 80, 90, kNone, false, false},
                                          {"unseen", 90, kNone, kNone, false, false}});
  EXPECT_EQ(times_found(svg, "<circle"), 2u);
  EXPECT_EQ(times_found(svg, "<path"), 1u);
  EXPECT_THAT(svg, HasSubstr("scene &lt;1>"));
  EXPECT_THAT(svg, HasSubstr(">1  a&amp;b: 40.0 mm at 10 frames/s<"));
  EXPECT_THAT(svg, Not(HasSubstr("2  ")));
  EXPECT_THAT(svg, Not(HasSubstr("unseen")));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_EQ(times_found(svg, "http"), 1u);  // the name space; nothing is fetched
}

// Speeds of 10 and 1000 with a margin of 15 % to either side are symmetric on a logarithmic axis
// from 64 to 740 px; an error of 40 of 40 mm is at the top, 72 px, half of it half-way to 432.
TEST(TradePlot, IsToScale) {
  const std::string svg = trade_plot_svg(
      "", "", {{"a", 10, 20, kNone, true, true}, {"b", 1000, 40, kNone, true, false}});
  const double margin = 676 * std::log10(1.15) / (2 + 2 * std::log10(1.15));
  char first[64], second[64];
  std::snprintf(first, sizeof first, "cx=\"%.1f\" cy=\"252.0\"", 64 + margin);
  std::snprintf(second, sizeof second, "cx=\"%.1f\" cy=\"72.0\"", 740 - margin);
  EXPECT_THAT(svg, HasSubstr(first));
  EXPECT_THAT(svg, HasSubstr(second));
}

TEST(TradePlot, NothingKnownIsAnEmptyPicture) {
  const std::string svg = trade_plot_svg("nothing", "error", {});
  EXPECT_THAT(svg, HasSubstr("</svg>"));
  EXPECT_THAT(svg, Not(HasSubstr("nan")));
  EXPECT_THAT(svg, Not(HasSubstr("inf")));
}

}  // namespace
}  // namespace walktrack
