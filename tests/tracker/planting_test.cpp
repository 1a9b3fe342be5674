#include "tracker/smooth/planting.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <Eigen/QR>

#include "body/kinematics.h"
#include "fixture.h"
#include "tests/tracker/frame_time.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr FlatFoot kStretch{Side::kLeft, 20, 32};

Vector2d foot_of(const Motion& motion, size_t row, Side side = Side::kLeft) {
  const JointPositions& joints = motion.joints[row];
  return 0.5 * (joints[ankle(side)] + joints[toe(side)]).head<2>();
}

// Left feet that go along a curve, right ones that stand.
Motion creeping(size_t rows = 60) {
  Motion motion;
  for (size_t i = 0; i < rows; ++i) {
    const double t = static_cast<double>(i) * kDt;
    motion.time.push_back(t);
    JointPositions& joints = motion.joints.emplace_back();
    joints.at.fill(Vector3d::Zero());
    joints[Joint::kLeftAnkle] = {0.1 * t, 0.03 * std::sin(5 * t), 0.08};
    joints[Joint::kLeftToe] = joints[Joint::kLeftAnkle] + Vector3d(0.15, 0.01, -0.05);
    joints[Joint::kRightAnkle] = {1, -0.2, 0.08};
    joints[Joint::kRightToe] = {1.15, -0.2, 0.03};
  }
  return motion;
}

double travel(const Motion& motion, const std::vector<FootShifts>& shifts, const FlatFoot& flat) {
  Eigen::AlignedBox2d box;
  for (size_t i = flat.first; i <= flat.last; ++i)
    box.extend(foot_of(motion, i, flat.side) + shifts[i][static_cast<size_t>(flat.side)]);
  return box.diagonal().norm();
}

std::vector<FootShifts> nowhere(size_t rows) {
  return std::vector<FootShifts>(rows, FootShifts{Vector2d::Zero(), Vector2d::Zero()});
}

TEST(PlantingShifts, AFootThatCreepsStandsWhereItWasOnAverage) {
  const Motion motion = creeping();
  const auto shifts = planting_shifts(motion, std::array{kStretch});
  const double before = travel(motion, nowhere(60), kStretch);
  EXPECT_GT(before, 0.04);
  EXPECT_LT(travel(motion, shifts, kStretch), 0.06 * before);
  Vector2d sum = Vector2d::Zero();
  for (size_t i = kStretch.first; i <= kStretch.last; ++i) sum += shifts[i][0];
  EXPECT_LT((sum / 13).norm(), 0.002);
  for (const size_t far : {size_t{0}, size_t{5}, size_t{47}, size_t{59}})
    EXPECT_LT(shifts[far][0].norm(), 1e-4) << far;
  for (const FootShifts& each : shifts) EXPECT_EQ(each[1], Vector2d::Zero()) << "the other foot";
}

// The header's sum by another route: all of its terms as rows of one dense least-squares problem.
TEST(PlantingShifts, AreTheLeastSquaresOfTheHeader) {
  const Motion motion = creeping(30);
  const std::array flats{FlatFoot{Side::kLeft, 3, 9}, FlatFoot{Side::kLeft, 17, 26}};
  constexpr double kTau = 0.04, kWeight = 50;
  constexpr Eigen::Index kRows = 30, kUnknowns = kRows + 2;
  Eigen::MatrixXd a = Eigen::MatrixXd::Zero(kRows + (kRows - 2) + 17, kUnknowns);
  Eigen::MatrixXd b = Eigen::MatrixXd::Zero(a.rows(), 2);
  Eigen::Index row = 0;
  for (Eigen::Index i = 0; i < kRows; ++i) a(row++, i) = 1;
  for (Eigen::Index i = 1; i + 1 < kRows; ++i)
    a.row(row++).segment<3>(i - 1) = std::pow(kTau / kDt, 2) * Eigen::RowVector3d(1, -2, 1);
  for (Eigen::Index k = 0; k < 2; ++k) {
    for (size_t i = flats[size_t(k)].first; i <= flats[size_t(k)].last; ++i) {
      a(row, Eigen::Index(i)) = std::sqrt(kWeight);
      a(row, kRows + k) = -std::sqrt(kWeight);
      b.row(row++) = -std::sqrt(kWeight) * foot_of(motion, i).transpose();
    }
  }
  ASSERT_EQ(row, a.rows());
  const Eigen::MatrixXd least = a.colPivHouseholderQr().solve(b);
  const auto shifts = planting_shifts(motion, flats);
  for (size_t i = 0; i < 30; ++i)
    EXPECT_LT((shifts[i][0] - least.row(Eigen::Index(i)).transpose()).norm(), 1e-9) << i;
}

TEST(PlantingShifts, FeetThatStandStayAndTheWorldMayBeTurned) {
  Motion motion = creeping();
  const std::array right{FlatFoot{Side::kRight, 10, 40}};
  for (const FootShifts& each : planting_shifts(motion, right)) EXPECT_LT(each[1].norm(), 1e-12);

  const auto shifts = planting_shifts(motion, std::array{kStretch});
  const Eigen::Rotation2Dd turn(0.8);
  for (JointPositions& joints : motion.joints) {
    for (Vector3d& joint : joints.at)
      joint.head<2>() = (turn * joint.head<2>() + Vector2d(300, -200)).eval();
  }
  const auto turned = planting_shifts(motion, std::array{kStretch});
  for (size_t i = 0; i < shifts.size(); ++i)
    EXPECT_LT((turned[i][0] - turn * shifts[i][0]).norm(), 1e-9) << i;
}

TEST(PlantingShifts, LeaveAloneWhatDoesNotStand) {
  const Motion motion = creeping();
  const auto none = [&](const Motion& of, const FlatFoot& flat) {
    for (const FootShifts& each : planting_shifts(of, std::array{flat}))
      EXPECT_TRUE(each[0].isZero(0) && each[1].isZero(0));
  };
  Motion strides = motion, lost = motion;
  for (size_t i = 0; i < strides.joints.size(); ++i)
    strides.joints[i][Joint::kLeftAnkle].x() += 0.08 * double(i);
  lost.joints[25] = unknown_joints();
  none(strides, kStretch);
  none(lost, kStretch);
  none(motion, {Side::kLeft, 20, 20});
  none(motion, {Side::kLeft, 50, 60});
  EXPECT_TRUE(planting_shifts({}, {}).empty());
}

TEST(PlantingShifts, DoNotReachAcrossLostFrames) {
  Motion motion = creeping();
  motion.joints[34] = unknown_joints();
  const auto shifts = planting_shifts(motion, std::array{kStretch});
  EXPECT_GT(shifts[33][0].norm(), 1e-4);
  for (size_t i = 34; i < 60; ++i) EXPECT_TRUE(shifts[i][0].isZero(1e-15)) << i;
}

// A pose and its joints are moved alike, and so are bands and samples.
TEST(PlantFeet, MoveJointsPoseBandsAndSamples) {
  const Body body = make_body({}, {});
  Pose pose;
  pose.root = {0.2, 0.1, 0.9};
  pose.heading = -3;
  pose.legs[0] = {0.35, 0.02, 0.05, 0.15, 0.05};
  pose.legs[1] = {-0.3, 0.02, 0.05, 0.25, 0.1};
  FrameRecord record = record_of(body, pose);
  const FrameEstimate& estimate = record.estimate;
  const FrameRecord before = record;
  const FootShifts by{Vector2d(0.02, -0.01), Vector2d(-0.015, 0.02)};
  plant_feet(by, record);
  const JointPositions drawn = forward_kinematics(body, estimate.pose).joints;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const auto a = static_cast<size_t>(ankle(side));
    const Vector3d moved = estimate.joints.at[a] - before.estimate.joints.at[a];
    EXPECT_TRUE(moved.head<2>().isApprox(by[static_cast<size_t>(side)], 1e-9));
    for (const Joint joint : {knee(side), ankle(side), toe(side)})
      EXPECT_LT((drawn[joint] - estimate.joints[joint]).norm(), 0.003);
    EXPECT_NEAR(estimate.spread[a][0].p95, estimate.joints.at[a].x() + 0.03, 1e-12);
    EXPECT_EQ(estimate.spread[a][0].sd, 0.015);
    EXPECT_EQ(record.samples[1].at[a], estimate.joints.at[a]);
  }
  EXPECT_EQ(estimate.joints[Joint::kPelvis], before.estimate.joints[Joint::kPelvis]);
  EXPECT_EQ(estimate.pose.root, before.estimate.pose.root);
}

TEST(PlantFeet, LiftToesOutOfTheGround) {
  const Body body = make_body({}, {});
  Pose pose;
  pose.root = {0, 0, 0.9};
  pose.legs[0].ankle_dorsiflexion = -0.5;
  FrameRecord record = record_of(body, pose);
  const FrameEstimate& estimate = record.estimate;
  ASSERT_LT(estimate.joints[Joint::kLeftToe].z(), 0);
  ASSERT_GT(estimate.joints[Joint::kLeftAnkle].z(), 0);
  plant_feet({Vector2d::Zero(), Vector2d::Zero()}, record);
  EXPECT_EQ(estimate.joints[Joint::kLeftToe].z(), 0);
  EXPECT_EQ(record.samples[0][Joint::kLeftToe].z(), 0);
  EXPECT_GT(estimate.pose.legs[0].ankle_dorsiflexion, -0.5);
}

TEST(PlantFeet, LeaveFramesThatAreNotTracked) {
  FrameRecord record;
  for (Vector3d& joint : record.estimate.joints.at) joint.setConstant(-1);
  plant_feet({Vector2d(1, 1), Vector2d(1, 1)}, record);
  for (const Vector3d& joint : record.estimate.joints.at) EXPECT_EQ(joint, Vector3d::Constant(-1));
}

}  // namespace
}  // namespace walktrack
