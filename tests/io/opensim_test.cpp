#include "io/tables/opensim.h"

#include <algorithm>
#include <map>
#include <sstream>

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

// A storage file's columns by name, and its rows.
struct Storage {
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;
  std::vector<double> column(const std::string& name) const {
    const auto at = std::find(names.begin(), names.end(), name) - names.begin();
    std::vector<double> out;
    for (const auto& row : rows) out.push_back(row.at(static_cast<size_t>(at)));
    return out;
  }
};

// As OpenSim's DelimFileAdapter reads it: lines with '=' are keys, the names follow "endheader",
// the first is "time", every row has as many cells as there are names.
Storage read_storage(const std::string& text) {
  std::istringstream stream(text);
  std::map<std::string, std::string> keys;
  std::string line;
  while (std::getline(stream, line) && line != "endheader")
    if (const size_t at = line.find('='); at != std::string::npos)
      keys[line.substr(0, at)] = line.substr(at + 1);
  Storage out;
  std::getline(stream, line);
  out.names = split(line, '\t');
  while (std::getline(stream, line)) {
    out.rows.emplace_back();
    for (const std::string& cell : split(line, '\t')) out.rows.back().push_back(std::stod(cell));
    EXPECT_EQ(out.rows.back().size(), out.names.size());
  }
  EXPECT_EQ(out.names.front(), "time");
  EXPECT_EQ(keys["version"], "1");
  EXPECT_EQ(keys["nRows"], std::to_string(out.rows.size()));
  EXPECT_EQ(keys["nColumns"], std::to_string(out.names.size()));
  EXPECT_EQ(keys.size(), 4u);  // with inDegrees: no sentence was taken for a key
  return out;
}

// Four frames: nobody known, right foot in the air, right foot loaded, right foot in the air.
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
