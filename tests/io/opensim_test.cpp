#include "io/opensim.h"

#include <sstream>

#include <map>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "body/kinematics.h"
#include "core/conventions.h"

namespace walktrack {
namespace {

using testing::HasSubstr;
using testing::StartsWith;

std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, at);) parts.push_back(part);
  return parts;
}

Motion two_frames() {
  Motion motion;
  motion.time = {0, 0.04};
  JointPositions joints = unknown_joints();
  for (size_t j = 0; j < kJointCountWithoutArms; ++j) joints.at[j] = {1, 2, 3};
  motion.joints = {joints, joints};
  motion.joints[1][Joint::kNeck].setConstant(NAN);
  return motion;
}

// OpenSim's TRCFileAdapter: five header lines, then a blank one; every row has the same cells.
TEST(Trc, HasTheFormOpenSimReads) {
  const auto lines = split(trc_from_motion(two_frames(), 25, "joints.trc"), '\n');
  ASSERT_EQ(lines.size(), 8u);
  EXPECT_EQ(lines[0], "PathFileType\t4\t(X/Y/Z)\tjoints.trc");
  EXPECT_EQ(lines[2], "25\t25\t2\t11\tm\t25\t1\t2");
  EXPECT_THAT(lines[3], StartsWith("Frame#\tTime\tpelvis\t\t\tneck\t\t\thead"));
  EXPECT_THAT(lines[4], StartsWith("\t\tX1\tY1\tZ1\tX2"));
  EXPECT_EQ(lines[5], "");
  EXPECT_THAT(lines[6], StartsWith("1\t0.000000\t1.000000\t3.000000\t-2.000000\t1.0"));
  EXPECT_THAT(lines[7], StartsWith("2\t0.040000\t1.000000\t3.000000\t-2.000000\t\t\t\t1.0"));
}

// A row of angles.mot by column name.
std::map<std::string, double> angles_of_row(const Pose& pose) {
  const std::vector<double> times{0.5};
  const std::string text = mot_from_poses(times, {&pose, 1}, "angles");
  const auto lines = split(text.substr(text.find("endheader\n") + 10), '\n');
  const auto names = split(lines[0], '\t'), cells = split(lines[1], '\t');
  EXPECT_EQ(names.size(), cells.size());
  EXPECT_THAT(text, HasSubstr("nColumns=" + std::to_string(names.size()) + "\n"));
  EXPECT_THAT(text, HasSubstr("nRows=1\n"));
  std::map<std::string, double> row;
  for (size_t i = 0; i < names.size(); ++i) row[names[i]] = std::stod(cells[i]);
  return row;
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
  EXPECT_EQ(row["pelvis_tx"], 1);
  EXPECT_EQ(row["pelvis_ty"], 3);
  EXPECT_EQ(row["pelvis_tz"], -2);
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

Eigen::Matrix3d about(const Eigen::Vector3d& axis, double angle_deg) {
  return Eigen::AngleAxisd(rad_from_deg(angle_deg), axis).toRotationMatrix();
}

// Composing the written angles as OpenSim does gives the thigh's direction of forward kinematics.
TEST(Mot, ComposedAnglesPointTheThighWhereKinematicsDoes) {
  const Body body = make_body(Subject{}, {});
  Pose pose;
  pose.heading = 0.4;
  pose.list = 0.1;
  pose.tilt = 0.2;
  pose.legs[0] = {0.6, 0.15, 0.1, 0.5, 0.1};
  pose.legs[1] = {-0.3, 0.1, -0.2, 0.2, 0.0};
  auto row = angles_of_row(pose);
  const auto x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
             z = Eigen::Vector3d::UnitZ();
  const Eigen::Matrix3d pelvis = about(z, row["pelvis_tilt"]) * about(x, row["pelvis_list"]) *
                                 about(y, row["pelvis_rotation"]);
  const Skeleton skeleton = forward_kinematics(body, pose);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const std::string end = side == Side::kLeft ? "_l" : "_r";
    const double mirror = side == Side::kLeft ? -1 : 1;
    const Eigen::Matrix3d thigh = pelvis * about(z, row["hip_flexion" + end]) *
                                  about(mirror * x, row["hip_adduction" + end]) *
                                  about(mirror * y, row["hip_rotation" + end]);
    const Eigen::Vector3d down = thigh * -y;
    const Eigen::Vector3d truth =
        (skeleton.joints[knee(side)] - skeleton.joints[hip(side)]).normalized();
    EXPECT_LT((down - Eigen::Vector3d(truth.x(), truth.z(), -truth.y())).norm(), 1e-6);
  }
}

}  // namespace
}  // namespace walktrack
