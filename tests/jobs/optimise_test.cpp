#include "jobs/optimise/optimise.h"

#include <cmath>

#include <gtest/gtest.h>

#include "core/errors.h"
#include "core/rng.h"
#include "io/archive/files.h"
#include "io/scene/scene.h"
#include "io/tables/motion_file.h"
#include "metrics/joint_error.h"
#include "tests/data_folders.h"
#include "tests/message_of.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

constexpr double kRaised = 0.05;  // m, of the floor of the other tool

// The demo's truth as another tool might see it: with noise of 2 cm, 5 cm above the floor.
Motion seen_by_others(const Motion& truth) {
  Rng rng(1, Purpose::kTest);
  Motion out = truth;
  for (JointPositions& joints : out.joints)
    for (Eigen::Vector3d& joint : joints.at)
      joint +=
          Eigen::Vector3d(0.02 * rng.normal(), 0.02 * rng.normal(), kRaised + 0.02 * rng.normal());
  return out;
}

double error_of(const Motion& truth, const Motion& motion) {
  double sum = 0;
  size_t count = 0;
  for (size_t i = 0; i < std::min(truth.time.size(), motion.time.size()); ++i)
    for (const Joint joint : kScoredJoints)
      if (const Eigen::Vector3d off = motion.joints[i][joint] - truth.joints[i][joint];
          known(off)) {
        sum += off.norm();
        ++count;
      }
  return sum / static_cast<double>(count);
}

struct Optimised : testing::Test {
  TemporaryFolder folder;
  Motion truth = read_motion(kDemo / "truth.csv");
  Motion given = seen_by_others(truth);
  OptimiseJob job;

  Optimised() {
    write_file_atomically(folder / "given.csv", motion_csv(given));
    job.motion = folder / "given.csv";
    job.output = folder / "out";
    job.height = 1.75;
    job.overlay = false;
  }
  const Change& change(const OptimiseOutcome& outcome, std::string_view name) {
    return *std::find_if(outcome.changes.begin(), outcome.changes.end(),
                         [&](const Change& each) { return each.name == name; });
  }
};

TEST_F(Optimised, FeetStandOnTheFloorAndJointsComeNearer) {
  const OptimiseOutcome outcome = optimise(job, {});
  EXPECT_NEAR(outcome.floor_height, kRaised, 0.02);
  EXPECT_EQ(outcome.used, truth.time.size());
  const Change& slide = change(outcome, "foot_slide_worst_mm");
  EXPECT_GT(slide.before, 15);
  EXPECT_LT(slide.after, 0.3 * slide.before);
  EXPECT_LT(change(outcome, "jitter_m_s3").after, 0.2 * change(outcome, "jitter_m_s3").before);
  EXPECT_LT(change(outcome, "torque_rate_nm_s").after, change(outcome, "torque_rate_nm_s").before);
  EXPECT_LT(change(outcome, "penetration_mm").after, 1);
  EXPECT_LT(error_of(truth, read_motion(job.output / "joints.csv")), 0.5 * error_of(truth, given));
  EXPECT_TRUE(std::filesystem::exists(job.output / "report.html"));
  EXPECT_FALSE(std::filesystem::exists(job.output / "frames.bin"));
}

// The other tool places the subject 6 cm beside the place where the cameras see them.
TEST_F(Optimised, ImagesBringItToItsPlace) {
  for (JointPositions& joints : given.joints)
    for (Eigen::Vector3d& joint : joints.at) joint.x() += 0.06;
  write_file_atomically(folder / "given.csv", motion_csv(given));
  optimise(job, {});
  const double alone = error_of(truth, read_motion(job.output / "joints.csv"));
  EXPECT_GT(alone, 0.055);
  job.scene = read_scene(kDemo / "scene.yaml");
  job.output = folder / "seen";
  optimise(job, {});
  EXPECT_LT(error_of(truth, read_motion(job.output / "joints.csv")), 0.6 * alone);
}

TEST_F(Optimised, ComplainsOfMotionsThatItCannotUse) {
  Motion without = given;
  for (JointPositions& joints : without.joints) joints[Joint::kLeftHip].setConstant(std::nan(""));
  write_file_atomically(folder / "given.csv", motion_csv(without));
  EXPECT_NE(message_of([&] { optimise(job, {}); }).find("no frame with hips"), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(job.output / "frames.bin"));
  job.motion = folder / "none.csv";
  EXPECT_THROW(optimise(job, {}), InputError);
}

}  // namespace
}  // namespace walktrack
