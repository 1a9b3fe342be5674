#include "io/tables/motion_file.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "core/rng.h"
#include "tests/io/sample_files.h"

namespace walktrack {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

constexpr double kHalfDigit = 0.5000001e-6;  // six decimals are written

Motion random_motion(bool arms) {
  Rng rng(3, Purpose::kTest);
  Motion motion;
  for (int i = 0; i < 5; ++i) {
    motion.time.push_back(i / 30.0);
    JointPositions joints = unknown_joints();
    const size_t count = arms ? kJointCount : kJointCountWithoutArms;
    for (size_t j = 0; j < count; ++j) {
      joints.at[j] = {3 * rng.normal(), 3 * rng.normal(), rng.uniform()};
    }
    motion.joints.push_back(joints);
  }
  motion.joints[2][Joint::kLeftKnee] = Vector3d::Constant(NAN);
  return motion;
}

void expect_near(const Motion& a, const Motion& b, double tolerance) {
  ASSERT_EQ(a.time.size(), b.time.size());
  for (size_t i = 0; i < a.time.size(); ++i) {
    EXPECT_NEAR(a.time[i], b.time[i], tolerance);
    for (size_t j = 0; j < kJointCount; ++j) {
      const Vector3d& left = a.joints[i].at[j];
      const Vector3d& right = b.joints[i].at[j];
      ASSERT_EQ(known(left), known(right)) << i << " " << kJointNames[j];
      if (known(left)) {
        EXPECT_LE((left - right).cwiseAbs().maxCoeff(), tolerance);
      }
    }
  }
}

TEST(MotionFile, RoundTripsWithAndWithoutArms) {
  const TemporaryFolder folder;
  for (const bool arms : {false, true}) {
    const Motion motion = random_motion(arms);
    const std::string text = motion_csv(motion);
    EXPECT_EQ(text.find("lwrist_x") != std::string::npos, arms);
    expect_near(read_motion(folder.write("j.csv", text)), motion, kHalfDigit);
  }
}

TEST(MotionFile, RoundTripsThroughOtherAxes) {
  const TemporaryFolder folder;
  const Motion motion = random_motion(false);
  for (const Vector3d& normal : {Vector3d(0, 1, 0), Vector3d(0, 0, -1), Vector3d(0.2, 0.1, 1)}) {
    const WorldFrame world = world_frame_on_ground(normal, 0.3);
    const std::string file = folder.write("j.csv", motion_csv(motion, world));
    // Numbers are rounded in the file's axes: the error is up to sqrt(3) times as large in the
    // world's.
    expect_near(read_motion(file, world), motion, 2 * kHalfDigit);
  }
}

TEST(MotionFile, WritesTheContractsColumns) {
  const std::string text = motion_csv(random_motion(false));
  EXPECT_THAT(text, testing::StartsWith("t,pelvis_x,pelvis_y,pelvis_z,neck_x,"));
  EXPECT_THAT(text, HasSubstr("rtoe_x,rtoe_y,rtoe_z\n0.000000,"));
}

TEST(MotionFile, TakesColumnsInAnyOrderAndPassesOverForeignJoints) {
  const TemporaryFolder folder;
  const Motion motion = read_motion(folder.write(
      "j.csv", "lheel_x,lheel_y,lheel_z,neck_y,neck_x,neck_z,t\n1,2,3,5,4,6,0\n,,,,4,6,1\n"));
  EXPECT_EQ(motion.joints[0][Joint::kNeck], Vector3d(4, 5, 6));
  EXPECT_FALSE(known(motion.joints[1][Joint::kNeck]));
  EXPECT_FALSE(known(motion.joints[0][Joint::kHead]));
}

TEST(MotionFile, NamesWhatIsWrong) {
  const TemporaryFolder folder;
  const std::vector<std::pair<std::string, std::string>> cases{
      {"x\n", "j.csv:1: found column 'x', allowed: t and <joint>_x, _y, _z"},
      {"t,lkne_x,lkne_y,lkne_z\n", "column 'lkne_x', allowed: 'lknee' is nearest"},
      {"t,neck_x,neck_y\n", "no column 'neck_z'"},
      {"neck_x,neck_y,neck_z\n", "no column 't'"},
      {"t\n0\n0\n", "j.csv:3: t: found '0', allowed: times that increase"},
      {"t\n\n,\n", "found 2 cells"},
      {"t,neck_x,neck_y,neck_z\n0,1,2,z\n", "j.csv:2: neck_z: found 'z', allowed: a number"},
  };
  for (const auto& [text, expected] : cases) {
    const std::string file = folder.write("j.csv", text);
    try {
      read_motion(file);
      FAIL() << "read " << text;
    } catch (const InputError& error) {
      EXPECT_THAT(error.what(), HasSubstr(expected));
    }
  }
}

JointUncertainty random_uncertainty(const Motion& motion) {
  Rng rng(4, Purpose::kTest);
  JointUncertainty uncertainty;
  uncertainty.time = motion.time;
  for (const JointPositions& joints : motion.joints) {
    JointPositions sd = unknown_joints(), low = sd, high = sd;
    for (size_t j = 0; j < kJointCountWithoutArms; ++j) {
      const Vector3d width(rng.uniform(), rng.uniform(), rng.uniform());
      sd.at[j] = width;
      low.at[j] = joints.at[j] - 2 * width;
      high.at[j] = joints.at[j] + width;
    }
    uncertainty.sd.push_back(sd);
    uncertainty.p05.push_back(low);
    uncertainty.p95.push_back(high);
  }
  return uncertainty;
}

TEST(UncertaintyFile, RoundTripsInWorldAxes) {
  const TemporaryFolder folder;
  const Motion motion = random_motion(false);
  const JointUncertainty written = random_uncertainty(motion);
  const JointUncertainty read =
      read_uncertainty(folder.write("u.csv", uncertainty_csv(motion, written)));
  expect_near({read.time, read.sd}, {written.time, written.sd}, 1e-6);
  expect_near({read.time, read.p05}, {written.time, written.p05}, 1e-6);
  expect_near({read.time, read.p95}, {written.time, written.p95}, 1e-6);
}

// z down: y and z change sign, so that lower ends become upper ends.
TEST(UncertaintyFile, SwapsPercentilesWhereAnAxisTurnsRound) {
  const TemporaryFolder folder;
  const Motion motion = random_motion(false);
  const JointUncertainty written = random_uncertainty(motion);
  const WorldFrame world = world_frame_on_ground({0, 0, -1}, 0);
  const JointUncertainty read =
      read_uncertainty(folder.write("u.csv", uncertainty_csv(motion, written, world)));
  const Vector3d low = written.p05[0][Joint::kHead], high = written.p95[0][Joint::kHead];
  EXPECT_LT((read.p05[0][Joint::kHead] - Vector3d(low.x(), -high.y(), -high.z())).norm(), 2e-6);
  EXPECT_LT((read.p95[0][Joint::kHead] - Vector3d(high.x(), -low.y(), -low.z())).norm(), 2e-6);
  EXPECT_LT((read.sd[0][Joint::kHead] - written.sd[0][Joint::kHead]).norm(), 2e-6);
}

TEST(MotionFile, ReadsTheSharedMotionCapture) {
  const std::string root = shared_data("mocap");
  if (!std::filesystem::exists(root)) GTEST_SKIP() << "no " << root;
  for (const auto& entry : std::filesystem::directory_iterator(root)) {
    if (entry.path().filename() == "index.csv") continue;
    const Motion motion = read_motion(entry.path());
    EXPECT_GT(motion.time.size(), 50u) << entry.path();
    EXPECT_TRUE(known(motion.joints[0][Joint::kPelvis])) << entry.path();
  }
}

}  // namespace
}  // namespace walktrack
