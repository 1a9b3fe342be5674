#include "io/tables/opensim.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <span>
#include <sstream>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "body/kinematics.h"
#include "core/conventions.h"
#include "core/errors.h"

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

// A line as OpenSim cuts it: at every tab; what follows the last tab is a cell if it is not empty.
std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  size_t at = 0;
  for (size_t tab = 0; (tab = line.find('\t', at)) != std::string::npos; at = tab + 1)
    cells.push_back(line.substr(at, tab - at));
  if (at < line.size()) cells.push_back(line.substr(at));
  return cells;
}

std::vector<std::string> without_empty(std::vector<std::string> cells) {
  std::erase(cells, "");
  return cells;
}

struct Markers {
  std::vector<std::string> names;
  std::vector<double> time;
  std::vector<std::vector<Eigen::Vector3d>> rows;  // NaN = missing
};

// A .trc as OpenSim 4 reads it (TRCFileAdapter): eight keys with a value each; as many names as
// NumMarkers; X1, Y1, Z1, ...; then rows, of 2 + 3 NumMarkers cells each or the file is refused,
// where a marker with an empty cell is missing. Blank lines may come before the first row, and the
// first one after it ends the table.
Markers read_trc(const std::string& text) {
  const auto refuse = [](const std::string& why) { throw InputError(why); };
  const auto lines = split(text, '\n');
  if (lines.size() < 6 || !lines[0].starts_with("PathFileType")) refuse("no header");
  const auto keys = without_empty(cells_of(lines[1])), values = without_empty(cells_of(lines[2]));
  if (keys.size() != 8 || values.size() != 8 || keys[3] != "NumMarkers") refuse("keys");
  const size_t markers = std::stoul(values[3]);
  Markers out;
  out.names = without_empty(cells_of(lines[3]));
  if (out.names.size() != markers + 2 || out.names[0] != "Frame#" || out.names[1] != "Time")
    refuse("names");
  out.names.erase(out.names.begin(), out.names.begin() + 2);
  const auto axes = without_empty(cells_of(lines[4]));
  for (size_t k = 0; k < 3 * markers; ++k)
    if (axes.at(k) != std::string(1, "XYZ"[k % 3]) + std::to_string(k / 3 + 1)) refuse("axes");
  size_t line = 5;
  while (line < lines.size() && cells_of(lines[line]).empty()) ++line;
  for (; line < lines.size() && !cells_of(lines[line]).empty(); ++line) {
    const auto cells = cells_of(lines[line]);
    if (cells.size() != 3 * markers + 2)
      refuse("expected " + std::to_string(3 * markers + 2) + " cells, found " +
             std::to_string(cells.size()));
    out.time.push_back(std::stod(cells[1]));
    std::vector<Eigen::Vector3d>& row = out.rows.emplace_back();
    for (size_t c = 2; c < cells.size(); c += 3) {
      const bool known = !cells[c].empty() && !cells[c + 1].empty() && !cells[c + 2].empty();
      row.push_back(known ? Eigen::Vector3d(std::stod(cells[c]), std::stod(cells[c + 1]),
                                            std::stod(cells[c + 2]))
                          : Eigen::Vector3d::Constant(NAN));
    }
  }
  if (out.rows.size() != std::stoul(values[2])) refuse("frames");
  return out;
}

// A marker missing, the last one missing, nobody there, everybody there.
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
  // As many cells in a row as columns in the head: other tools read it as one table.
  for (const size_t row : {4, 6, 7})
    EXPECT_EQ(std::count(lines[row].begin(), lines[row].end(), '\t'), 2 + 3 * 11) << row;
}

constexpr double kHipWidth = 0.15452;  // m, of the model that is not scaled

// A row of angles.mot by column name.
std::map<std::string, double> angles_of_row(const Pose& pose, double hip_width = kHipWidth) {
  const std::vector<double> times{0.5};
  const std::string text = mot_from_poses(times, {&pose, 1}, hip_width, "angles");
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

Eigen::Matrix3d about(const Eigen::Vector3d& axis, double angle_deg) {
  return Eigen::AngleAxisd(rad_from_deg(angle_deg), axis).toRotationMatrix();
}

// The model in OpenSim with the written coordinates: its pelvis, hips where the Rajagopal model has
// them in a pelvis of the subject's size, thighs, shanks and feet of the subject's lengths. Joints
// in OpenSim's ground.
std::map<std::string, Eigen::Vector3d> opensim_joints(std::map<std::string, double> row,
                                                      const BodyLengths& lengths) {
  const auto x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
             z = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d origin(row["pelvis_tx"], row["pelvis_ty"], row["pelvis_tz"]);
  const Eigen::Matrix3d pelvis = about(z, row["pelvis_tilt"]) * about(x, row["pelvis_list"]) *
                                 about(y, row["pelvis_rotation"]);
  const double scale = lengths.hip_width / (2 * 0.07726);
  std::map<std::string, Eigen::Vector3d> out;
  for (const std::string end : {"l", "r"}) {
    const double right = end == "r" ? 1 : -1;
    const auto angle = [&](const std::string& name) { return row[name + "_" + end]; };
    const Eigen::Vector3d hip =
        origin + pelvis * (scale * Eigen::Vector3d(-0.056276, -0.07849, right * 0.07726));
    const Eigen::Matrix3d thigh = pelvis * about(z, angle("hip_flexion")) *
                                  about(right * x, angle("hip_adduction")) *
                                  about(right * y, angle("hip_rotation"));
    const Eigen::Matrix3d shank = thigh * about(z, -angle("knee_angle"));
    const Eigen::Matrix3d foot = shank * about(z, angle("ankle_angle"));
    const Eigen::Vector3d knee = hip - lengths.thigh * thigh.col(1),
                          ankle = knee - lengths.shank * shank.col(1);
    out[end + "hip"] = hip;
    out[end + "knee"] = knee;
    out[end + "ankle"] = ankle;
    out[end + "toe"] =
        ankle +
        foot * Eigen::Vector3d(lengths.ball_forward, lengths.ball_height - lengths.ankle_height, 0);
  }
  return out;
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
  const auto found = opensim_joints(angles_of_row(pose, body.lengths.hip_width), body.lengths);
  const Skeleton skeleton = forward_kinematics(body, pose);
  for (const auto& [name, place] : found) {
    const auto at = std::ranges::find(kJointNames, name) - kJointNames.begin();
    const Eigen::Vector3d& truth = skeleton.joints.at[static_cast<size_t>(at)];
    // Six digits of metres and of degrees along a leg.
    EXPECT_LT((place - Eigen::Vector3d(truth.x(), truth.z(), -truth.y())).norm(), 2e-6) << name;
  }
}

// Feet flat on the ground in joints.csv are so in OpenSim: neither sunken nor floating.
TEST(Mot, FeetStandOnTheGround) {
  const Body body = make_body(Subject{}, {});
  Pose pose;
  pose.root.z() = leg_length(body.lengths);
  const auto found = opensim_joints(angles_of_row(pose, body.lengths.hip_width), body.lengths);
  for (const char* side : {"l", "r"}) {
    EXPECT_NEAR(found.at(side + std::string("ankle")).y(), body.lengths.ankle_height, 2e-6);
    EXPECT_NEAR(found.at(side + std::string("toe")).y(), body.lengths.ball_height, 2e-6);
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
