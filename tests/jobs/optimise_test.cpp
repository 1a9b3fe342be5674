#include "jobs/optimise/optimise.h"

#include <cmath>
#include <tuple>

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

// The given joints are evidence, too: one camera, which sees distances badly, does not pull a
// figure away that is in its place.
TEST_F(Optimised, OneCameraLeavesItInItsPlace) {
  optimise(job, {});
  const double alone = error_of(truth, read_motion(job.output / "joints.csv"));
  job.scene = read_scene(kDemo / "scene.yaml");
  job.scene->cameras.resize(1);
  job.output = folder / "seen";
  optimise(job, {});
  EXPECT_LT(error_of(truth, read_motion(job.output / "joints.csv")), 1.25 * alone);
}

JointPositions mirrored(const JointPositions& joints) {
  JointPositions out = joints;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Side other = side == Side::kLeft ? Side::kRight : Side::kLeft;
    for (const auto joint : {hip, knee, ankle, toe}) out[joint(side)] = joints[joint(other)];
  }
  for (Eigen::Vector3d& joint : out.at) joint.y() = -joint.y();
  return out;
}

// A law: a mirrored person moves as the mirrored motion, with left and right exchanged.
TEST_F(Optimised, MirroredMotionsStayMirrored) {
  optimise(job, {});
  const Motion once = read_motion(job.output / "joints.csv");
  Motion other = given;
  for (JointPositions& joints : other.joints) joints = mirrored(joints);
  write_file_atomically(folder / "given.csv", motion_csv(other));
  job.output = folder / "mirrored";
  optimise(job, {});
  const Motion twice = read_motion(job.output / "joints.csv");
  ASSERT_EQ(once.time.size(), twice.time.size());
  for (size_t i = 0; i < once.time.size(); ++i)
    for (const Joint joint : kScoredJoints)
      EXPECT_LT((mirrored(twice.joints[i])[joint] - once.joints[i][joint]).norm(), 1e-3) << i;
}

TEST_F(Optimised, JointsThatAreFarOffForAMomentAreReplaced) {
  optimise(job, {});
  const double before = error_of(truth, read_motion(job.output / "joints.csv"));
  for (size_t i = 40; i < 42; ++i)
    given.joints[i][Joint::kRightAnkle] += Eigen::Vector3d(0, 0.3, -0.6);
  write_file_atomically(folder / "given.csv", motion_csv(given));
  job.output = folder / "again";
  EXPECT_EQ(optimise(job, {}).replaced, 2u);
  EXPECT_LT(error_of(truth, read_motion(job.output / "joints.csv")), before + 0.001);
}

// Nothing of arms, rows and times is lost, although times are rounded in the file.
TEST_F(Optimised, KeepsArmsRowsAndTimes) {
  for (size_t i = 0; i < given.time.size(); ++i) {
    given.time[i] = 2 + std::round(1e4 * static_cast<double>(i) / 60) / 1e4;
    JointPositions& joints = given.joints[i];
    for (const auto& [shoulder, elbow, wrist, y] :
         {std::tuple{Joint::kLeftShoulder, Joint::kLeftElbow, Joint::kLeftWrist, 0.2},
          std::tuple{Joint::kRightShoulder, Joint::kRightElbow, Joint::kRightWrist, -0.2}}) {
      joints[shoulder] = joints[Joint::kNeck] + Eigen::Vector3d(0, y, -0.05);
      joints[elbow] = joints[shoulder] - Eigen::Vector3d(0, 0, 0.3);
      joints[wrist] = joints[elbow] - Eigen::Vector3d(0, 0, 0.25);
    }
  }
  write_file_atomically(folder / "given.csv", motion_csv(given));
  EXPECT_EQ(optimise(job, {}).frames, given.time.size());
  const Motion found = read_motion(job.output / "joints.csv");
  EXPECT_NEAR(found.time.front(), given.time.front(), 1e-3);
  EXPECT_NEAR(found.time.back(), given.time.back(), 1e-3);
  EXPECT_TRUE(known(found.joints[30][Joint::kLeftWrist]));
  EXPECT_LT(found.joints[30][Joint::kLeftWrist].z(), found.joints[30][Joint::kLeftElbow].z());
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
