#include "jobs/prior/prior.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "core/errors.h"
#include "gait/prior/prior_file.h"
#include "io/archive/files.h"
#include "jobs/prior/prior_pictures.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

class PriorJobs : public testing::Test {
 protected:
  fs::path folder = fs::path(testing::TempDir()) / "walktrack_prior_test";
  void SetUp() override {
    fs::remove_all(folder);
    fs::create_directories(folder);
  }
  void TearDown() override { fs::remove_all(folder); }
};

TEST_F(PriorJobs, ReportHoldsTablesAndPictures) {
  PriorReportJob job;
  job.output = folder / "shown";
  job.walkers = 4;
  job.threads = 1;
  report_prior(job, {});
  const std::string gaits = read_text_file(job.output / "gaits.csv", 1 << 20);
  EXPECT_THAT(gaits, testing::StartsWith("speed,step_length,slope,period"));
  EXPECT_EQ(size_t(std::count(gaits.begin(), gaits.end(), '\n')),
            load_gait_prior().nodes.size() + 1);
  for (const char* name : {"cost.svg", "cheapest_step.svg", "strips.svg"})
    EXPECT_THAT(read_text_file(job.output / name, 1 << 20), HasSubstr("</svg>")) << name;
  EXPECT_THROW(report_prior(job, {}), UsageError);
}

// Two neighbouring nodes of the shipped table are kept; an interruption leaves a part from which
// building resumes.
TEST_F(PriorJobs, BuildKeepsEarlierGaitsAndGoesOnFromItsPart) {
  const GaitPrior shipped = load_gait_prior();
  const size_t i = 6, j = 3, k = shipped.slopes.size() / 2;
  PriorJob job;
  job.grid.speeds = {shipped.speeds[i], shipped.speeds[i + 1]};
  job.grid.ratios = {shipped.ratios[j]};
  job.grid.slopes = {shipped.slopes[k]};
  job.grid.sweeps = 0;
  job.output = folder / "table.txt";
  job.earlier = folder / "earlier.txt";
  job.threads = 1;
  write_file_atomically(job.earlier, shipped_gait_prior_text());
  const std::atomic<bool> stop = true;
  EXPECT_FALSE(build_prior(job, {.report = {}, .message = {}, .stop_request = &stop}));
  EXPECT_FALSE(fs::exists(job.output));
  EXPECT_TRUE(fs::exists(folder / "table.txt.part"));
  fs::remove(job.earlier);
  EXPECT_TRUE(build_prior(job, {}));
  EXPECT_FALSE(fs::exists(folder / "table.txt.part"));
  const GaitPrior built = parse_gait_prior(read_text_file(job.output, 1 << 20), "table");
  ASSERT_EQ(built.nodes.size(), 2u);
  EXPECT_EQ(built.node(1, 0, 0).gait, shipped.node(i + 1, j, k).gait);
  EXPECT_THROW(build_prior(job, {}), UsageError);
}

// The anthropomorphic walker's table takes a second, and its slice on level ground less.
TEST_F(PriorJobs, AnthropomorphicTableIsBuiltAndShown) {
  PriorJob job;
  job.grid.slopes = {0};
  job.output = folder / "legs.txt";
  build_straight_prior(job, {});
  EXPECT_THROW(build_straight_prior(job, {}), UsageError);
  PriorReportJob shown;
  shown.prior = job.output;
  shown.output = folder / "legs";
  shown.walkers = 4;
  report_straight_prior(shown, {});
  const std::string gaits = read_text_file(shown.output / "gaits.csv", 1 << 20);
  EXPECT_EQ(std::count(gaits.begin(), gaits.end(), '\n'), 11 * 7 + 1);
  EXPECT_THAT(gaits, HasSubstr("hip_stiffness,toe_off_impulse,least_normal"));
  EXPECT_THAT(read_text_file(shown.output / "cost.svg", 1 << 20), HasSubstr("</svg>"));
}

// People make longer steps when they walk faster, like v^0.42; so does the table, which does not
// contain this law.
TEST(CheapestStep, GrowsWithSpeedAsPeoplesDo) {
  const WalkerUnits units = walker_units(adult_walker(1.75, 70));
  const auto steps = cheapest_steps(cost_table(load_gait_prior()), units);
  double n = 0, x = 0, y = 0, xx = 0, xy = 0;
  for (const CheapestStep& s : steps) {
    if (s.speed < 0.8 || s.speed > 1.8) continue;
    const double a = std::log(s.speed), b = std::log(s.step_length);
    n += 1;
    x += a;
    y += b;
    xx += a * a;
    xy += a * b;
    const double preferred = units.length * preferred_step_length(s.speed / units.speed());
    EXPECT_NEAR(s.step_length / preferred, 1, 0.25) << s.speed;
  }
  ASSERT_GE(n, 4);
  EXPECT_NEAR((n * xy - x * y) / (n * xx - x * x), 0.42, 0.1);
}

}  // namespace
}  // namespace walktrack
