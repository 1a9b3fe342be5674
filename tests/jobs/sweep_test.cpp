#include "jobs/sweep/sweep.h"

#include <atomic>
#include <cmath>
#include <filesystem>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/scene/render_file.h"
#include "io/tables/csv.h"
#include "jobs/render/render.h"
#include "tests/message_of.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

using testing::HasSubstr;
using testing::Not;

namespace fs = std::filesystem;

// A second of a walk in front of two small cameras, rendered once; few particles.
class Sweep : public testing::Test {
 protected:
  static void SetUpTestSuite() {
    folder_ = new TemporaryFolder;
    const std::string options = folder_->write("options.yaml", R"(
frame_rate: 30
duration: 0.7
walk: {speed: 1.25, start: [-0.4, 0], phase: 0.2}
initial: true
background_frames: 3
images: true
cameras:
  - {name: side, azimuth_deg: -90, distance: 3.6, height: 1.2, focal_px: 130, size: [120, 96]}
  - {name: front, azimuth_deg: -20, distance: 4, height: 1.7, focal_px: 130, size: [120, 96]}
)");
    RenderFile file = read_render_file(options);
    RenderJob job;
    job.walker = std::move(file.subject);
    job.options = std::move(file.options);
    job.output = folder_->path() / "scene";
    render_scene(job, {});
  }
  static void TearDownTestSuite() { delete folder_; }

  static SweepJob job(const std::string& name, const std::vector<std::string>& over) {
    SweepJob job;
    job.scene = read_scene(folder_->path() / "scene/scene.yaml");
    job.config.values.tracker.start.particles = 10;
    job.config.values.tracker.filter.moves = 1;
    job.parameters = swept_parameters(over, job.scene, job.config);
    job.seeds = 2;
    job.output = folder_->path() / name;
    return job;
  }

  static TemporaryFolder* folder_;
};

TemporaryFolder* Sweep::folder_ = nullptr;

std::vector<double> errors_of(const SweepReport& report) {
  std::vector<double> out;
  for (const SweepRow& row : report.rows)
    for (const SweepRun& run : row.runs) out.push_back(run.error_mm);
  return out;
}

// Counts tracked frames, and interrupts after some of them.
struct Watch {
  size_t reports = 0, last = 0, total = 0;
  size_t stop_after = SIZE_MAX;
  std::atomic<bool> stop{false};
  JobControl control() {
    JobControl control;
    control.stop_request = &stop;
    control.report = [this](const Progress& progress) {
      EXPECT_GE(progress.done, last);
      last = progress.done;
      total = progress.total;
      if (++reports >= stop_after) stop = true;
    };
    return control;
  }
};

TEST_F(Sweep, MeasuresEverySettingWithEverySeedOnce) {
  const SweepJob each = job("grid", {"particles=10:30,cameras=1:2"});
  Watch first, again;
  const SweepReport report = run_sweep(each, first.control());
  ASSERT_EQ(report.rows.size(), 4u);
  EXPECT_FALSE(report.interrupted);
  EXPECT_EQ(report.error_is, "joint error (7 joints), mean, mm");
  EXPECT_EQ(report.reference, "truth.csv");
  for (const SweepRow& row : report.rows) {
    ASSERT_EQ(row.runs.size(), 2u);
    EXPECT_NE(row.runs[0].error_mm, row.runs[1].error_mm) << "seeds differ";
    EXPECT_GT(row.error_mm, 1);
    EXPECT_LT(row.error_mm, 500);
    EXPECT_GT(row.seconds_per_frame, 0);
    EXPECT_GT(row.cpu_seconds_per_frame, 0);
  }
  EXPECT_EQ(first.last, first.total);
  // Repeated: nothing is tracked, with one progress report for each run; and a sweep with more
  // values reuses these.
  EXPECT_EQ(errors_of(run_sweep(each, again.control())), errors_of(report));
  EXPECT_EQ(again.reports, 8u);
  // A run of which a part was removed is tracked again.
  for (const auto& entry : fs::recursive_directory_iterator(each.output / "runs"))
    if (entry.path().filename() == "joints.csv") {
      fs::remove(entry.path());
      break;
    }
  EXPECT_EQ(errors_of(run_sweep(each, {})), errors_of(report));
}

TEST_F(Sweep, GoesOnWhereItWasInterruptedAndErrorsAreThoseOfOneGo) {
  SweepJob each = job("interrupted", {"particles=10:20"});
  Watch watch;
  watch.stop_after = 30;  // in the second of four runs of 22 frames
  const SweepReport part = run_sweep(each, watch.control());
  EXPECT_TRUE(part.interrupted);
  ASSERT_EQ(part.rows.size(), 1u);
  EXPECT_EQ(part.rows[0].runs.size(), 1u);
  EXPECT_THAT(sweep_markdown(part, {}), HasSubstr("Interrupted"));
  const std::vector<double> resumed = errors_of(run_sweep(each, {}));
  each.output = folder_->path() / "one_go";
  each.config.values.threads = 1;
  EXPECT_EQ(errors_of(run_sweep(each, {})), resumed);
}

TEST_F(Sweep, WithoutTruthMeasuresAgainstTheRichestSettingAndSaysSo) {
  SweepJob each = job("no_truth", {"particles=30:10"});
  each.scene.truth.clear();
  each.seeds = 1;
  const SweepReport report = run_sweep(each, {});
  EXPECT_FALSE(report.against_truth);
  EXPECT_EQ(report.reference, "a run of particles=30 with seed 2");
  EXPECT_GT(report.rows[0].error_mm, 0);  // not measured against itself
  EXPECT_THAT(sweep_markdown(report, {}), HasSubstr("There is no truth"));
}

TEST_F(Sweep, RunsOfAnotherConfigurationAreNotReusedOrOverwrittenUnasked) {
  SweepJob each = job("other", {"particles=10"});
  each.seeds = 1;
  run_sweep(each, {});
  each.config.values.tracker.filter.moves = 2;
  EXPECT_THAT(message_of<UsageError>([&] { run_sweep(each, {}); }),
              HasSubstr("with other settings or inputs (filter.moves 1 -> 2); -y"));
  each.again = true;
  EXPECT_NO_THROW(run_sweep(each, {}));
}

TEST_F(Sweep, WritesItsTables) {
  const SweepJob each = job("grid", {"particles=10:30,cameras=1:2"});
  const SweepReport report = run_sweep(each, {});
  write_sweep(report, sweep_advice(report, {}), each);
  const CsvTable table = read_csv(each.output / "sweep.csv");
  EXPECT_EQ(table.rows.size(), 4u);
  EXPECT_EQ(table.columns[1], "cameras");
  EXPECT_NEAR(table.number(table.rows[3], table.column("error_mm")), report.rows[3].error_mm, 1e-3);
  const auto json = nlohmann::json::parse(read_text_file(each.output / "sweep.json", 1u << 20));
  EXPECT_EQ(json.at("settings").size(), 4u);
  EXPECT_EQ(json.at("settings")[3].at("setting").at("particles"), "30");
  EXPECT_EQ(json.at("complete"), true);
  EXPECT_THAT(read_text_file(each.output / "sweep.svg", 1u << 20), HasSubstr("</svg>"));
  EXPECT_THAT(read_text_file(each.output / "sweep.md", 1u << 20),
              HasSubstr("| particles=30 cameras=2 |"));
}

SweepRun run_of(double error_mm, double seconds, double lost = 0) {
  return {1, std::isfinite(error_mm), error_mm, lost, seconds, seconds};
}

SweepReport made_report(std::vector<std::vector<SweepRun>> runs) {
  SweepReport report;
  report.parameters = {{"particles", {}}};
  for (auto& each : runs) {
    report.rows.push_back({{std::to_string(report.rows.size())}, std::move(each)});
  }
  summarise_sweep(report.rows, 0.1);
  return report;
}

TEST(SweepSummary, MeansDeviationsAndTheFront) {
  const SweepReport report = made_report({
      {run_of(10, 1), run_of(14, 3), run_of(12, 2)},
      {run_of(30, 0.1), run_of(NAN, 0.1, 1)},  // one seed found nobody
      {run_of(20, 0.5)},
      {run_of(25, 0.6)},       // the one before is better
      {run_of(5, 0.01, 0.3)},  // lost for longer than the check allows
  });
  EXPECT_DOUBLE_EQ(report.rows[0].error_mm, 12);
  EXPECT_DOUBLE_EQ(report.rows[0].error_sd_mm, 2);
  EXPECT_DOUBLE_EQ(report.rows[0].seconds_per_frame, 2);
  EXPECT_DOUBLE_EQ(report.rows[1].error_mm, 30);
  EXPECT_DOUBLE_EQ(report.rows[1].lost_share, 0.5);
  EXPECT_TRUE(std::isnan(report.rows[2].error_sd_mm));
  std::vector<bool> holds, front;
  for (const SweepRow& row : report.rows) {
    holds.push_back(row.holds);
    front.push_back(row.on_front);
  }
  EXPECT_EQ(holds, (std::vector<bool>{true, false, true, true, false}));
  EXPECT_EQ(front, (std::vector<bool>{true, false, true, false, false}));
}

std::string advice_of(const SweepReport& report, const SweepWish& wish) {
  std::string text;
  for (const std::string& sentence : sweep_advice(report, wish)) text += sentence + "\n";
  return text;
}

TEST(SweepAdvice, SaysWhatToUseForAWish) {
  const SweepReport report =
      made_report({{run_of(20, 0.1)}, {run_of(21, 0.05)}, {run_of(40, 0.01)}});
  const std::string plain = advice_of(report, {});
  EXPECT_THAT(plain, HasSubstr("Most accurate: particles=0: 20.0 mm at 10 frames/s."));
  EXPECT_THAT(plain, HasSubstr("Fastest within 10 % of that error: particles=1"));
  EXPECT_THAT(plain, HasSubstr("Fastest that keeps the track: particles=2"));
  const std::string wished = advice_of(report, {15, 30});
  EXPECT_THAT(wished, HasSubstr("For 15 frames/s use particles=1: 21.0 mm at 20 frames/s."));
  EXPECT_THAT(wished, HasSubstr("For an error of at most 30 mm use particles=1"));
  EXPECT_THAT(wished, HasSubstr("--set filter.particles=1"));
  const std::string vain = advice_of(report, {1000, 3});
  EXPECT_THAT(vain, HasSubstr("None of these settings reaches 1000 frames/s"));
  EXPECT_THAT(vain, HasSubstr("None of these settings comes within 3 mm"));
}

TEST(SweepAdvice, WhereEverySettingLosesTheWalkerNothingIsRecommended) {
  const SweepReport report = made_report({{run_of(NAN, 0.1, 1)}, {run_of(5, 0.1, 0.9)}});
  EXPECT_THAT(advice_of(report, {}), HasSubstr("nothing can be recommended"));
}

}  // namespace
}  // namespace walktrack
