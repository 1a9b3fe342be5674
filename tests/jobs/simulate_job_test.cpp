#include "jobs/simulate/simulate_job.h"

#include <filesystem>
#include <fstream>
#include <sstream>

#include <gtest/gtest.h>

#include "core/errors.h"
#include "io/scene/model_file.h"
#include "io/tables/csv.h"
#include "io/video/video.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;

SimulateJob job_of(const std::string& model) {
  SimulateJob job;
  job.model = default_model(model);
  job.duration = 2;
  job.simulation.max_step = 2e-3;
  return job;
}

TEST(SimulateJob, EveryModelGivesTablesPicturesAndAVideo) {
  for (const std::string& model : model_names()) {
    SCOPED_TRACE(model);
    const fs::path folder = fs::path(testing::TempDir()) / ("simulate_" + model);
    fs::remove_all(folder);
    simulate_into(folder, false, job_of(model), {"walktrack"}, {});
    for (const char* name : {"states.csv", "events.csv", "model.yaml", "strip.svg", "strip.png",
                             "animation.mp4", "run.json"}) {
      EXPECT_GT(fs::file_size(folder / name), 50u) << name;
    }
    const CsvTable states = read_csv(folder / "states.csv");
    EXPECT_NEAR(states.number(states.rows.back(), 0), 2, 1e-9);
    FrameSource video(folder / "animation.mp4");
    EXPECT_NEAR(video.facts().frame_count, 60, 2);
    EXPECT_THROW(simulate_into(folder, false, job_of(model), {}, {}), UsageError);
  }
}

TEST(SimulateJob, EnergyColumnsAddUpAndThePassiveRunnerKeepsIt) {
  const SimulateJob job = job_of("monopode");
  const auto walker = make_walker(job.model);
  const CsvTable table = csv_from_text(states_csv(*walker, record(*walker, job, {})), "states.csv");
  const double start = table.number(table.rows[0], table.column("energy"));
  EXPECT_NEAR(start, 1784.8, 1e-6);
  for (const CsvTable::Row& row : table.rows) {
    double sum = 0;
    for (const char* part : {"kinetic", "gravity", "elastic"}) {
      sum += table.number(row, table.column(part));
    }
    const double energy = table.number(row, table.column("energy"));
    EXPECT_NEAR(sum, energy, 1e-6);
    EXPECT_NEAR(energy, start, 1e-4 * start);  // RK4 at 2 ms over ten contacts
  }
}

TEST(SimulateJob, StopsAfterTheStepsAskedForAndAtAFall) {
  SimulateJob job = job_of("anthropomorphic");
  job.duration = 30;
  job.steps = 2;
  const auto walker = make_walker(job.model);
  EXPECT_EQ(record(*walker, job, {}).steps, 2);
  job.model.start.qd = {-0.5, 0};  // backwards
  const Recording fallen = record(*walker, job, {});
  EXPECT_EQ(fallen.end.health, Health::kFallen);
  EXPECT_EQ(fallen.events.back().transition.kind, EventKind::kFall);
}

// With every shipped parameter set a step returns to its start.
TEST(SimulateJob, ShippedModelsAreCycles) {
  int count = 0;
  for (const auto& entry :
       fs::directory_iterator(fs::path(WALKTRACK_SOURCE_DIR) / "configs/models")) {
    SCOPED_TRACE(entry.path().filename());
    const ModelSpec spec = read_model("", entry.path(), {});
    const auto walker = make_walker(spec);
    const Eigen::VectorXd x = start_point(spec, *walker);
    const Eigen::Index n = x.size() / 2;
    const auto step = take_step(*walker, walker->section_state(x.head(n), x.tail(n)), {}, 20);
    ASSERT_TRUE(step);
    // The starts are rounded: the worst is a guess of an apex, .96 for .959569.
    EXPECT_LT((walker->section_point(step->end) - x).norm(), 2e-3 * (1 + x.norm()));
    ++count;
  }
  EXPECT_GE(count, 26);
}

}  // namespace
}  // namespace walktrack
