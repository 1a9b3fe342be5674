#include "jobs/evaluate/truth.h"

#include <array>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/tables/csv.h"
#include "io/tables/marker_file.h"
#include "io/tables/motion_file.h"

namespace walktrack {
inline namespace jobs {

namespace {

constexpr std::string_view kKinds =
    "joints (t,pelvis_x,…), foot plants (stance,side,on_frame,off_frame,x_m), ground points "
    "(t,x,y) or Pose2Sim key points (frame,…,RHip_x,…)";

double required_rate(const CsvTable& table, std::optional<double> frame_rate) {
  if (frame_rate) return *frame_rate;
  throw UsageError(fmt::format("{}: it counts frames: say --frame-rate HZ", table.file));
}

std::vector<FootPlant> foot_plants(const CsvTable& table, double rate) {
  const size_t side = table.column("side"), on = table.column("on_frame");
  const size_t off = table.column("off_frame"), place = table.column("x_m");
  std::vector<FootPlant> plants;
  for (const CsvTable::Row& row : table.rows) {
    const std::string& letter = row.cells[side];
    if (letter != "l" && letter != "r") table.fail(row, side, "l or r");
    plants.push_back({letter == "l" ? Side::kLeft : Side::kRight, table.number(row, on) / rate,
                      table.number(row, off) / rate, table.number(row, place)});
  }
  return plants;
}

GroundPoints ground_points(const CsvTable& table) {
  const size_t t = table.column("t"), x = table.column("x"), y = table.column("y");
  GroundPoints out;
  for (const CsvTable::Row& row : table.rows) {
    out.time.push_back(table.number(row, t));
    out.points.emplace_back(table.number(row, x), table.number(row, y));
  }
  return out;
}

constexpr std::array<std::pair<std::string_view, Joint>, 6> kKeyPoints{{
    {"LHip", Joint::kLeftHip},
    {"LKnee", Joint::kLeftKnee},
    {"LAnkle", Joint::kLeftAnkle},
    {"RHip", Joint::kRightHip},
    {"RKnee", Joint::kRightKnee},
    {"RAnkle", Joint::kRightAnkle},
}};

Eigen::Vector3d point_in(const CsvTable& table, const CsvTable::Row& row, const std::string& name) {
  constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();
  const auto value = [&](const char* axis) {
    return table.optional_number(row, table.column(name + axis)).value_or(kUnknown);
  };
  return {value("_x"), value("_y"), value("_z")};
}

// Hips, knees, ankles and the pelvis between the hips. The other key points are at other places
// than the joints here.
Motion key_points(const CsvTable& table, double rate) {
  const size_t frame = table.column("frame");
  Motion motion;
  for (const CsvTable::Row& row : table.rows) {
    motion.time.push_back(table.number(row, frame) / rate);
    JointPositions joints = unknown_joints();
    for (const auto& [name, joint] : kKeyPoints)
      joints[joint] = point_in(table, row, std::string(name));
    joints[Joint::kPelvis] = 0.5 * (joints[Joint::kLeftHip] + joints[Joint::kRightHip]);
    motion.joints.push_back(joints);
  }
  return motion;
}

}  // namespace

Truth read_truth(const std::filesystem::path& path, std::optional<double> frame_rate) {
  if (is_marker_file(path)) return read_motion(path);
  const CsvTable table = read_csv(path);
  const auto has = [&](const char* column) { return table.find_column(column).has_value(); };
  if (has("t") && has("pelvis_x")) return read_motion(path);
  if (has("on_frame") && has("x_m")) return foot_plants(table, required_rate(table, frame_rate));
  if (has("t") && has("x") && has("y")) return ground_points(table);
  if (has("frame") && has("RHip_x")) return key_points(table, required_rate(table, frame_rate));
  throw InputError(describe({table.file, table.header_line, ""},
                            fmt::format("the columns {}", fmt::join(table.columns, ",")), kKinds));
}

}  // namespace jobs
}  // namespace walktrack
