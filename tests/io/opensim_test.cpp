#include "io/tables/opensim.h"

#include <algorithm>
#include <map>
#include <span>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "body/kinematics.h"
#include "core/conventions.h"
#include "tests/io/opensim_reader.h"

namespace walktrack {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

Motion two_frames() {
  Motion motion;
  motion.time = {0, 0.04};
  JointPositions joints = unknown_joints();
  for (size_t j = 0; j < kJointCountWithoutArms; ++j) joints.at[j] = {1, 2, 3};
  motion.joints = {joints, joints};
  motion.joints[1][Joint::kNeck].setConstant(NAN);
  return motion;
}

// One marker missing, the last one missing, no marker, all markers.
TEST(Trc, IsReadAsOpenSimReadsItWithWhatIsMissing) {
  Motion motion = two_frames();
  motion.time = {0, 0.04, 0.08, 0.12};
  motion.joints.push_back(unknown_joints());
  motion.joints.push_back(motion.joints[0]);
  motion.joints[0][Joint::kRightToe].setConstant(NAN);
  const Markers markers = read_trc(trc_from_motion(motion, 25, "joints.trc"));
  EXPECT_EQ(markers.names.front(), "pelvis");
  EXPECT_EQ(markers.names.back(), "rtoe");
  EXPECT_EQ(markers.time, motion.time);
  const Eigen::Vector3d there(1, 3, -2);
  const auto neck = static_cast<size_t>(Joint::kNeck), toe = static_cast<size_t>(Joint::kRightToe);
  EXPECT_EQ(markers.rows[0][neck], there);
  EXPECT_TRUE(markers.rows[0][toe].hasNaN());
  EXPECT_TRUE(markers.rows[1][neck].hasNaN());
  EXPECT_EQ(markers.rows[1][toe], there);
  for (const Eigen::Vector3d& marker : markers.rows[2]) EXPECT_TRUE(marker.hasNaN());
  for (const Eigen::Vector3d& marker : std::span(markers.rows[3]).first(toe))
    EXPECT_EQ(marker, there);
}

TEST(Trc, HasTheFormOfItsKind) {
  const auto lines = split(trc_from_motion(two_frames(), 25, "joints.trc"), '\n');
  ASSERT_EQ(lines.size(), 8u);
  EXPECT_EQ(lines[0], "PathFileType\t4\t(X/Y/Z)\tjoints.trc");
  EXPECT_EQ(lines[2], "25\t25\t2\t11\tm\t25\t1\t2");
  EXPECT_THAT(lines[3], StartsWith("Frame#\tTime\tpelvis\t\t\tneck\t\t\thead"));
  EXPECT_THAT(lines[4], StartsWith("\t\tX1\tY1\tZ1\tX2"));
  EXPECT_EQ(lines[5], "");
  EXPECT_THAT(lines[6], StartsWith("1\t0.000000\t1.000000\t3.000000\t-2.000000\t1.0"));
  EXPECT_THAT(lines[7], StartsWith("2\t0.040000\t1.000000\t3.000000\t-2.000000\t\t\t\t1.0"));
  // All rows have as many cells as the header has columns, so that other tools read them as one
  // table.
  for (const size_t row : {4, 6, 7})
    EXPECT_EQ(std::count(lines[row].begin(), lines[row].end(), '\t'), 2 + 3 * 11) << row;
}

// Legs as long as those of the model that is not scaled.
const BodyLengths kModel = [] {
  BodyLengths lengths = body_lengths({});
  lengths.thigh = 0.41;
  lengths.shank = 0.40;
  return lengths;
}();

// A row of angles.mot by column name.
std::map<std::string, double> angles_of_row(const Pose& pose, const BodyLengths& lengths = kModel) {
  const std::vector<double> times{0.5};
  return read_storage(mot_from_poses(times, {&pose, 1}, lengths, "angles")).row(0);
}

constexpr double kDigits = 1e-6;  // degrees, as written

TEST(Mot, SingleAnglesHaveTheSignsOfTheHeader) {
  Pose pose;
  pose.root = {1, 2, 3};
  pose.legs[0].hip_flexion = 0.1;
  pose.legs[1].hip_abduction = 0.2;
  pose.legs[0].knee_flexion = 0.3;
  pose.legs[1].ankle_dorsiflexion = -0.4;
  auto row = angles_of_row(pose);
  EXPECT_EQ(row["time"], 0.5);
  EXPECT_NEAR(row["pelvis_tx"], 1 + 0.056276, 1e-6);
  EXPECT_NEAR(row["pelvis_ty"], 3 + 0.07849, 1e-6);
  EXPECT_NEAR(row["pelvis_tz"], -2, 1e-6);
  EXPECT_NEAR(row["hip_flexion_l"], deg_from_rad(0.1), kDigits);
  EXPECT_NEAR(row["hip_adduction_r"], -deg_from_rad(0.2), kDigits);
  EXPECT_NEAR(row["knee_angle_l"], deg_from_rad(0.3), kDigits);
  EXPECT_NEAR(row["ankle_angle_r"], -deg_from_rad(0.4), kDigits);
  for (const char* zero : {"pelvis_tilt", "hip_flexion_r", "hip_adduction_l", "hip_rotation_r",
                           "lumbar_extension", "lumbar_bending"}) {
    EXPECT_NEAR(row[zero], 0, kDigits) << zero;
  }
}

TEST(Mot, PelvisAndLumbarSigns) {
  Pose pose;
  pose.tilt = 0.1;
  EXPECT_NEAR(angles_of_row(pose)["pelvis_tilt"], -deg_from_rad(0.1), kDigits);
  pose = {};
  pose.heading = 0.7;
  EXPECT_NEAR(angles_of_row(pose)["pelvis_rotation"], deg_from_rad(0.7), kDigits);
  pose = {};
  pose.list = 0.05;
  auto row = angles_of_row(pose);
  EXPECT_NEAR(row["pelvis_list"], deg_from_rad(0.05), kDigits);
  EXPECT_NEAR(row["lumbar_bending"], -deg_from_rad(0.05), kDigits);  // the trunk stays upright
}

TEST(Mot, TheModelInOpenSimStandsWhereTheJointsAre) {
  Subject subject;
  subject.height = 1.6;
  const Body body = make_body(subject, {});
  Pose pose;
  pose.root = {1, -2, 0.9};
  pose.heading = 0.4;
  pose.list = 0.1;
  pose.tilt = 0.2;
  pose.legs[0] = {0.6, 0.15, 0.1, 0.5, 0.1};
  pose.legs[1] = {-0.3, 0.1, -0.2, 0.2, 0.05};
  const auto found = opensim_joints(angles_of_row(pose, body.lengths), body.lengths);
  const Skeleton skeleton = forward_kinematics(body, pose);
  for (const auto& [name, place] : found) {
    const auto at = std::ranges::find(kJointNames, name) - kJointNames.begin();
    const Eigen::Vector3d& truth = skeleton.joints.at[static_cast<size_t>(at)];
    // Six digits of metres and of degrees along a leg.
    EXPECT_LT((place - Eigen::Vector3d(truth.x(), truth.z(), -truth.y())).norm(), 2e-6) << name;
  }
}

// Feet that are flat on the ground in joints.csv are so in OpenSim.
TEST(Mot, FeetStandOnTheGround) {
  const Body body = make_body(Subject{}, {});
  Pose pose;
  pose.root.z() = leg_length(body.lengths);
  const auto found = opensim_joints(angles_of_row(pose, body.lengths), body.lengths);
  for (const char* side : {"l", "r"}) {
    EXPECT_NEAR(found.at(side + std::string("ankle")).y(), body.lengths.ankle_height, 2e-6);
    EXPECT_NEAR(found.at(side + std::string("toe")).y(), body.lengths.ball_height, 2e-6);
  }
}

// Four frames: unknown, right foot in the air, right foot loaded, right foot in the air.
Kinetics one_step() {
  Kinetics out;
  out.time = {0, 0.1, 0.2, 0.3};
  out.frames.resize(4);
  for (size_t i = 1; i < 4; ++i) out.frames[i].known = true;
  FootLoad& foot = out.frames[2].feet[static_cast<size_t>(Side::kRight)];
  foot.force = {10, 20, 700};
  foot.centre = {1.5, 0.25};
  foot.free_moment = 3;
  LegLoads& leg = out.frames[2].legs[static_cast<size_t>(Side::kLeft)];
  leg = {.hip_flexion = 1, .hip_abduction = 2, .knee_flexion = 3, .ankle_dorsiflexion = -4};
  return out;
}

TEST(GroundReactions, AreInOpenSimsAxesWithAPointOfActionAtEveryRow) {
  const Storage table = read_storage(mot_from_ground_reactions(one_step()));
  using testing::ElementsAre;
  EXPECT_THAT(table.column("time"), ElementsAre(0.1, 0.2, 0.3));  // the unknown row is left out
  EXPECT_THAT(table.column("ground_force_r_vx"), ElementsAre(0, 10, 0));
  EXPECT_THAT(table.column("ground_force_r_vy"), ElementsAre(0, 700, 0));
  EXPECT_THAT(table.column("ground_force_r_vz"), ElementsAre(0, -20, 0));
  EXPECT_THAT(table.column("ground_force_r_px"), ElementsAre(1.5, 1.5, 1.5));
  EXPECT_THAT(table.column("ground_force_r_py"), ElementsAre(0, 0, 0));
  EXPECT_THAT(table.column("ground_force_r_pz"), ElementsAre(-0.25, -0.25, -0.25));
  EXPECT_THAT(table.column("ground_torque_r_y"), ElementsAre(0, 3, 0));
  EXPECT_THAT(table.column("ground_force_l_px"), ElementsAre(0, 0, 0));  // never on the ground
}

TEST(JointMoments, HaveTheNamesAndSignsOfInverseDynamics) {
  const Storage table = read_storage(sto_from_joint_moments(one_step()));
  EXPECT_EQ(table.column("hip_flexion_l_moment")[1], 1);
  EXPECT_EQ(table.column("hip_adduction_l_moment")[1], -2);
  EXPECT_EQ(table.column("knee_angle_l_moment")[1], 3);
  EXPECT_EQ(table.column("ankle_angle_l_moment")[1], -4);
  EXPECT_EQ(table.column("knee_angle_r_moment")[1], 0);
  EXPECT_THAT(sto_from_joint_moments(one_step()), HasSubstr("\nRows: 10 per second.\n"));
}

}  // namespace
}  // namespace walktrack
