#include "io/tables/marker_file.h"

#include <array>
#include <cmath>
#include <limits>
#include <optional>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/c3d/c3d_read.h"
#include "io/tables/trc_read.h"

namespace walktrack {
inline namespace io {

namespace {

using Eigen::Vector3d;
constexpr size_t kMaxMarkerBytes = size_t{1} << 30;

std::string plain_name(std::string name) {
  if (const size_t colon = name.rfind(':'); colon != std::string::npos) name.erase(0, colon + 1);
  std::string out;
  for (const char c : name) {
    if (c == '_' || c == '-' || c == '.' || c == ' ') continue;
    out += c >= 'A' && c <= 'Z' ? static_cast<char>(c - 'A' + 'a') : c;
  }
  if (out.ends_with("study")) out.erase(out.size() - 5);
  return out;
}

// Names of a point of one side, in which * stands for the letter of the side: the joint's centre
// itself, otherwise the midpoint between a lateral and a medial marker.
struct SideNames {
  Joint left, right;
  std::string_view called;  // name in messages
  std::vector<std::string_view> centre, outer, inner;
};

const std::vector<SideNames>& side_names() {
  static const std::vector<SideNames> kNames{
      {Joint::kLeftHip,
       Joint::kRightHip,
       "hip",
       {"*hip", "*hjc", "*hjcreg", "hip*", "hjc*", "*fep"},
       {},
       {}},
      {Joint::kLeftKnee,
       Joint::kRightKnee,
       "knee",
       {"*knee", "*kjc", "knee*", "kjc*", "*feo"},
       {"*kne", "*knee", "*lfe"},
       {"*knm", "*mknee", "*mkne", "*mfe", "*kneem"}},
      {Joint::kLeftAnkle,
       Joint::kRightAnkle,
       "ankle",
       {"*ankle", "*ajc", "ankle*", "ajc*", "*tio"},
       {"*ank", "*ankle", "*lm"},
       {"*anm", "*mankle", "*mank", "*mm", "*anklem"}},
      {Joint::kLeftToe, Joint::kRightToe, "toe", {"*toe", "*bigtoe", "toe*", "bigtoe*"}, {}, {}},
      {Joint::kLeftShoulder,
       Joint::kRightShoulder,
       "shoulder",
       {"*shoulder", "*sjc", "shoulder*", "*sho"},
       {},
       {}},
      {Joint::kLeftElbow, Joint::kRightElbow, "elbow", {"*elbow", "*ejc", "elbow*"}, {}, {}},
      {Joint::kLeftWrist, Joint::kRightWrist, "wrist", {"*wrist", "*wjc", "wrist*"}, {}, {}},
  };
  return kNames;
}

class Finder {
 public:
  explicit Finder(const MarkerTable& markers) {
    for (const std::string& name : markers.names) names_.push_back(plain_name(name));
  }
  std::optional<size_t> find(std::string_view name) const {
    for (size_t i = 0; i < names_.size(); ++i)
      if (names_[i] == name) return i;
    return std::nullopt;
  }
  // Finds the column of one side, also with "left" and "right" in full.
  std::optional<size_t> find(const std::vector<std::string_view>& patterns, Side side) const {
    const bool left = side == Side::kLeft;
    for (const std::string_view pattern : patterns) {
      const size_t star = pattern.find('*');
      for (const std::string_view letter : {left ? "l" : "r", left ? "left" : "right"}) {
        std::string name(pattern);
        if (const auto found = find(name.replace(star, 1, letter))) return found;
      }
    }
    return std::nullopt;
  }

 private:
  std::vector<std::string> names_;
};

using Path = std::vector<Vector3d>;

Path path_of(const MarkerTable& markers, size_t index) {
  Path out;
  for (const auto& row : markers.points) out.push_back(row[index]);
  return out;
}

Path middle_of(const Path& a, const Path& b) {
  Path out;
  for (size_t i = 0; i < a.size(); ++i) out.push_back(0.5 * (a[i] + b[i]));
  return out;
}

std::optional<Path> joint_path(const MarkerTable& markers, const Finder& finder,
                               const SideNames& names, Side side) {
  const auto inner = finder.find(names.inner, side), outer = finder.find(names.outer, side);
  // Some marker sets name the lateral marker of a pair after the joint.
  if (inner && outer) return middle_of(path_of(markers, *outer), path_of(markers, *inner));
  const auto centre = finder.find(names.centre, side);
  return centre ? std::optional(path_of(markers, *centre)) : std::nullopt;
}

// Harrington et al. 2007, table 4: offsets from the midpoint of the anterior superior iliac spines
// in the pelvis's axes, by its width and depth (in mm there).
std::optional<std::array<Path, 2>> hips_of_pelvis(const MarkerTable& markers,
                                                  const Finder& finder) {
  const auto la = finder.find("lasi") ? finder.find("lasi") : finder.find("lasis");
  const auto ra = finder.find("rasi") ? finder.find("rasi") : finder.find("rasis");
  const auto lp = finder.find("lpsi") ? finder.find("lpsi") : finder.find("lpsis");
  const auto rp = finder.find("rpsi") ? finder.find("rpsi") : finder.find("rpsis");
  const auto sacrum = finder.find("sacr");
  if (!la || !ra || !((lp && rp) || sacrum)) return std::nullopt;
  std::array<Path, 2> out;
  for (const auto& row : markers.points) {
    const Vector3d front = 0.5 * (row[*la] + row[*ra]);
    const Vector3d back = lp && rp ? 0.5 * (row[*lp] + row[*rp]) : row[*sacrum];
    const double width = (row[*ra] - row[*la]).norm(), depth = (front - back).norm();
    const Vector3d right = (row[*ra] - row[*la]).normalized();
    Vector3d ahead = front - back;
    ahead = (ahead - ahead.dot(right) * right).normalized();
    const Vector3d up = right.cross(ahead);
    const Vector3d centre =
        front + (-0.24 * depth - 0.0099) * ahead + (-0.30 * width - 0.0109) * up;
    const double aside = 0.33 * width + 0.0073;
    out[0].push_back(centre - aside * right);
    out[1].push_back(centre + aside * right);
  }
  return out;
}

// The mean over the rows in which the point is known.
Vector3d mean_of(const Path& path) {
  Vector3d sum = Vector3d::Zero();
  double count = 0;
  for (const Vector3d& point : path) {
    if (!known(point)) continue;
    sum += point;
    ++count;
  }
  return sum / count;
}

// world_from_file, with z up and right-handed.
Eigen::Matrix3d upright(const MarkerTable& markers, const Vector3d& up) {
  Eigen::Index axis = 0;
  if (!(up.cwiseAbs().maxCoeff(&axis) > 0.1) || up[axis] < 0)
    throw InputError(describe({markers.file, 0, ""},
                              fmt::format("hips {:.2f} m above the ankles along x, {:.2f} along y, "
                                          "{:.2f} along z",
                                          up.x(), up.y(), up.z()),
                              "somebody upright along one of the axes"));
  Eigen::Matrix3d world;
  // clang-format off
  if (axis == 2) world << 1, 0, 0,   0, 1, 0,   0, 0, 1;
  if (axis == 1) world << 1, 0, 0,   0, 0, -1,  0, 1, 0;
  if (axis == 0) world << 0, 1, 0,   0, 0, 1,   1, 0, 0;
  // clang-format on
  return world;
}

struct NamedPaths {
  std::array<std::optional<Path>, kJointCount> of;
  std::optional<Path>& operator[](Joint joint) { return of[static_cast<size_t>(joint)]; }
};

NamedPaths paths_of(const MarkerTable& markers) {
  const Finder finder(markers);
  NamedPaths out;
  for (const SideNames& names : side_names()) {
    out[names.left] = joint_path(markers, finder, names, Side::kLeft);
    out[names.right] = joint_path(markers, finder, names, Side::kRight);
  }
  if (!out[Joint::kLeftHip] || !out[Joint::kRightHip]) {
    if (auto hips = hips_of_pelvis(markers, finder)) {
      out[Joint::kLeftHip] = std::move((*hips)[0]);
      out[Joint::kRightHip] = std::move((*hips)[1]);
    }
  }
  for (const auto& [joint, names] :
       {std::pair<Joint, std::vector<std::string_view>>{Joint::kNeck, {"neck", "c7"}},
        {Joint::kHead, {"head", "headtop"}}})
    for (const std::string_view name : names)
      if (const auto found = finder.find(name); found && !out[joint])
        out[joint] = path_of(markers, *found);
  std::string missing;
  for (size_t i = 0; i < 3; ++i)
    for (const Side side : {Side::kLeft, Side::kRight})
      if (const SideNames& names = side_names()[i];
          !out[side == Side::kLeft ? names.left : names.right])
        missing += fmt::format("{}the {} {}", missing.empty() ? "" : ", ",
                               side == Side::kLeft ? "left" : "right", names.called);
  if (!missing.empty())
    throw InputError(describe({markers.file, 0, ""},
                              fmt::format("{} points without {}", markers.names.size(), missing),
                              "joint centres (LHip or LHJC, LKnee, LAnkle, ...), markers on both "
                              "sides of knees and ankles, "
                              "LASI, RASI, LPSI, RPSI for the hips"));
  out[Joint::kPelvis] = middle_of(*out[Joint::kLeftHip], *out[Joint::kRightHip]);
  return out;
}

}  // namespace

Motion motion_from_markers(const MarkerTable& markers) {
  NamedPaths paths = paths_of(markers);
  const Vector3d up = mean_of(*paths[Joint::kPelvis]) -
                      mean_of(middle_of(*paths[Joint::kLeftAnkle], *paths[Joint::kRightAnkle]));
  const Eigen::Matrix3d world = upright(markers, up);
  Motion motion;
  motion.time = markers.time;
  for (size_t i = 0; i < markers.time.size(); ++i) {
    JointPositions joints = unknown_joints();
    for (size_t k = 0; k < kJointCount; ++k)
      if (paths.of[k]) joints.at[k] = world * (*paths.of[k])[i];
    motion.joints.push_back(joints);
  }
  return motion;
}

bool is_marker_file(const std::filesystem::path& path) {
  const std::string ending = plain_name(path.extension().string());
  return ending == "trc" || ending == "c3d";
}

Motion read_marker_motion(const std::filesystem::path& path) {
  const std::string content = read_text_file(path, kMaxMarkerBytes);
  const bool trc = plain_name(path.extension().string()) == "trc";
  return motion_from_markers(trc ? markers_from_trc(content, path.string())
                                 : markers_from_c3d(content, path.string()));
}

}  // namespace io
}  // namespace walktrack
