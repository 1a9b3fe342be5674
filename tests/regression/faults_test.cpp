// Whether the suite detects faults of a tracker: they are planted into its results, its scenes or
// its configuration, never into its code, and each must take a value of a fast scene out of its
// band. README.md lists them.
#include <cmath>
#include <functional>
#include <limits>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/archive/run_record.h"
#include "io/tables/motion_file.h"
#include "tests/body/changed_motion.h"
#include "tests/regression/compared.h"

namespace walktrack {
namespace {

using Eigen::Vector3d;
using testing::IsEmpty;
using testing::Not;

using Results = std::vector<SuiteResult>;
using Fault = std::function<void(SuiteResult&)>;

std::vector<std::string> noticed(const std::string& scene, const Results& results) {
  return out_of_bands(read_bands(bands_file()), scene, values_of(results));
}

// The values that leave their bands if every run of the scene has the fault.
std::vector<std::string> noticed(const std::string& scene, const Fault& fault) {
  Results results = compared_results(scene);
  for (SuiteResult& result : results) fault(result);
  return noticed(scene, results);
}

Fault each_row(std::function<void(JointPositions&)> change) {
  return [change](SuiteResult& result) {
    for (JointPositions& joints : result.estimate.joints) change(joints);
  };
}

void delay_by_a_frame(SuiteResult& result) {
  auto& joints = result.estimate.joints;
  joints.insert(joints.begin(), joints.front());
  joints.pop_back();
}

void lose_the_second_half(SuiteResult& result) {
  auto& joints = result.estimate.joints;
  for (size_t i = joints.size() / 2; i < joints.size(); ++i) joints[i] = unknown_joints();
}

void scale_intervals(SuiteResult& result, double factor) {
  for (size_t i = 0; i < result.uncertainty.time.size(); ++i) {
    for (size_t j = 0; j < kJointCount; ++j) {
      Vector3d& low = result.uncertainty.p05[i].at[j];
      Vector3d& high = result.uncertainty.p95[i].at[j];
      const Vector3d middle = 0.5 * (low + high);
      low = middle + factor * (low - middle);
      high = middle + factor * (high - middle);
    }
  }
}

// Thighs and shanks keep their lengths, hips and ankles their places: to first order.
void straighten_knees(JointPositions& joints) {
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Vector3d middle = 0.5 * (joints[hip(side)] + joints[ankle(side)]);
    joints[knee(side)] += 0.3 * (middle - joints[knee(side)]);
  }
}

// Each row as if the body jumped back and forth.
void tremble(SuiteResult& result) {
  for (size_t i = 0; i < result.estimate.joints.size(); ++i)
    for (Vector3d& p : result.estimate.joints[i].at) p.x() += i % 2 == 0 ? 0.02 : -0.02;
}

TEST(PlantedFaults, InResultsTakeAFigureOutOfItsBand) {
  const std::map<std::string, Fault> faults{
      {"legs swapped", each_row(mirror_legs)},
      {"wrong sign of the knees' flexion", each_row(flip_knees)},
      {"2 % too large", each_row([](JointPositions& joints) {
         for (Vector3d& p : joints.at) p *= 1.02;
       })},
      {"mirrored world", each_row([](JointPositions& joints) {
         for (Vector3d& p : joints.at) p.y() = -p.y();
         mirror_legs(joints);
       })},
      {"ground 10 cm too low", each_row([](JointPositions& joints) {
         for (Vector3d& p : joints.at) p.z() -= 0.1;
       })},
      {"lost half-way", lose_the_second_half},
      {"intervals half as wide", [](SuiteResult& result) { scale_intervals(result, 0.5); }},
      {"intervals twice as wide", [](SuiteResult& result) { scale_intervals(result, 2); }},
      {"evidence counts twice", [](SuiteResult& result) { result.log_evidence *= 2; }},
      {"knees 10 degrees too straight", each_row(straighten_knees)},
      {"trembling by 2 cm", tremble},
  };
  for (const auto& [name, fault] : faults)
    EXPECT_THAT(noticed("three_cameras", fault), Not(IsEmpty())) << name;
}

TEST(PlantedFaults, AFrameOfDelayShowsWhereFramesAreFew) {
  EXPECT_THAT(noticed("seven_fps", delay_by_a_frame), Not(IsEmpty()));
}

// The suite's first run of a scene after a change of its job.
Results with(const std::string& name, const std::function<void(TrackJob&)>& change) {
  const auto scene = rendered_scene(name, compared_folder());
  TrackJob job = suite_job(name, scene, 1, compared_folder() / "faulty");
  change(job);
  return {tracked(job)};
}

TEST(PlantedFaults, ADroppedFlowTermTakesAFigureOutOfItsBand) {
  const auto drop = [](TrackJob& job) {
    apply_setting(job.config, "observation.flow.weight=0", "--set");
  };
  EXPECT_THAT(noticed("flow_only", with("flow_only", drop)), Not(IsEmpty()));
}

TEST(PlantedFaults, ADroppedBackgroundTermTakesAFigureOutOfItsBand) {
  const auto drop = [](TrackJob& job) {
    apply_setting(job.config, "observation.background.enabled=false", "--set");
  };
  EXPECT_THAT(noticed("one_camera", with("one_camera", drop)), Not(IsEmpty()));
}

TEST(PlantedFaults, ExchangedCalibrationsTakeAFigureOutOfItsBand) {
  const auto exchange = [](TrackJob& job) {
    std::swap(job.scene.cameras[0].camera, job.scene.cameras[1].camera);
  };
  EXPECT_THAT(noticed("three_cameras", with("three_cameras", exchange)), Not(IsEmpty()));
}

// Threads in another order: the tracker must not depend on it, and the suite must notice if it did,
// even if a single coordinate changed by its last written digit.
TEST(PlantedFaults, AnOrderThatDependsOnThreadsChangesTheDigest) {
  const auto scene = rendered_scene("one_camera", compared_folder());
  const auto run = [&](int threads) {
    TrackJob job = suite_job("one_camera", scene, 1, compared_folder() / "again");
    job.scene.last_frame = 12;
    job.config.values.threads = threads;
    return tracked(job);
  };
  const auto digest = [](const SuiteResult& result) {
    return result_digest(motion_csv(result.estimate),
                         uncertainty_csv(result.estimate, result.uncertainty));
  };
  SuiteResult result = run(1);
  EXPECT_EQ(run(3).digest, result.digest);
  const std::string before = digest(result);
  EXPECT_EQ(before, result.digest);
  result.estimate.joints[6][Joint::kLeftAnkle].y() += 1e-6;
  EXPECT_NE(digest(result), before);
}

}  // namespace
}  // namespace walktrack
