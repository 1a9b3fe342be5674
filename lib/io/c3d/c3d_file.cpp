#include "io/c3d/c3d_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include "body/joint_angles.h"
#include "core/conventions.h"
#include "core/version.h"
#include "io/c3d/c3d_parameters.h"
#include "io/tables/motion_file.h"

namespace walktrack {
inline namespace io {

namespace {

constexpr double kMmPerM = 1000;
constexpr int kMostInHeader = 65535;
constexpr size_t kMostEvents = 3500;  // 32 bytes each

constexpr std::array<std::string_view, kJointCount> kDescriptions{
    "midpoint of the hip joint centres",
    "height of C7 on the axis of the trunk",
    "centre of the head",
    "left hip joint centre",
    "left knee joint centre",
    "left ankle joint centre",
    "ball of the left foot",
    "right hip joint centre",
    "right knee joint centre",
    "right ankle joint centre",
    "ball of the right foot",
    "left shoulder joint centre",
    "left elbow joint centre",
    "left wrist joint centre",
    "right shoulder joint centre",
    "right elbow joint centre",
    "right wrist joint centre"};

// Three angles that are written as one point. kJointAngleCount stands for no angle; 0 is written.
struct AngleTriple {
  std::string_view label, description;
  std::array<JointAngle, 3> of;
  std::array<double, 3> sign;
};
constexpr std::array kTriples{
    AngleTriple{"LHipAngles",
                "flexion, adduction, toes inwards",
                {kHipFlexionL, kHipAdductionL, kHipRotationL},
                {1, 1, 1}},
    AngleTriple{
        "LKneeAngles", "flexion", {kKneeAngleL, kJointAngleCount, kJointAngleCount}, {1, 1, 1}},
    AngleTriple{"LAnkleAngles",
                "dorsiflexion",
                {kAnkleAngleL, kJointAngleCount, kJointAngleCount},
                {1, 1, 1}},
    AngleTriple{"RHipAngles",
                "flexion, adduction, toes inwards",
                {kHipFlexionR, kHipAdductionR, kHipRotationR},
                {1, 1, 1}},
    AngleTriple{
        "RKneeAngles", "flexion", {kKneeAngleR, kJointAngleCount, kJointAngleCount}, {1, 1, 1}},
    AngleTriple{"RAnkleAngles",
                "dorsiflexion",
                {kAnkleAngleR, kJointAngleCount, kJointAngleCount},
                {1, 1, 1}},
    AngleTriple{"PelvisAngles",
                "tilt forwards, right side down, turned left from x",
                {kPelvisTilt, kPelvisList, kPelvisRotation},
                {-1, 1, 1}},
    AngleTriple{"TrunkAngles",
                "against the pelvis: forwards, to the right, turned left",
                {kLumbarExtension, kLumbarBending, kLumbarRotation},
                {-1, 1, 1}}};

constexpr std::array kFeet{Side::kLeft, Side::kRight};
constexpr std::array<std::string_view, 6> kChannels{"Fx", "Fy", "Fz", "Mx", "My", "Mz"};
constexpr size_t kChannelCount = kFeet.size() * kChannels.size();

// The transform from the world's axes to the plate's, whose z points down. It is its own inverse.
Eigen::Vector3d in_plate(const Eigen::Vector3d& world) {
  return {world.x(), -world.y(), -world.z()};
}

// A horizontal rectangle on the ground, m.
struct Plate {
  Eigen::Vector2d low, high;
  Eigen::Vector3d centre() const {
    return {0.5 * (low.x() + high.x()), 0.5 * (low.y() + high.y()), 0};
  }
};

// The plate covers the walk, in whole metres, so that all contacts are on it.
Plate plate_under(const Motion& motion) {
  Plate plate{{0, 0}, {0, 0}};
  bool any = false;
  for (const JointPositions& joints : motion.joints) {
    const Eigen::Vector3d& pelvis = joints[Joint::kPelvis];
    if (!known(pelvis)) continue;
    const Eigen::Vector2d at = pelvis.head<2>();
    plate.low = any ? plate.low.cwiseMin(at).eval() : at;
    plate.high = any ? plate.high.cwiseMax(at).eval() : at;
    any = true;
  }
  plate.low = plate.low.array().floor() - 1;
  plate.high = plate.high.array().ceil() + 1;
  return plate;
}

std::array<double, kChannelCount> channels_of(const KineticsFrame& frame, const Plate& plate) {
  std::array<double, kChannelCount> out{};
  if (!frame.known) return out;
  for (size_t side = 0; side < kFeet.size(); ++side) {
    const FootLoad& foot = frame.feet[side];
    if (!foot.centre.allFinite()) continue;
    const Eigen::Vector3d arm =
        Eigen::Vector3d(foot.centre.x(), foot.centre.y(), 0) - plate.centre();
    const Eigen::Vector3d force = in_plate(foot.force),
                          moment = kMmPerM * in_plate(arm.cross(foot.force) +
                                                      Eigen::Vector3d(0, 0, foot.free_moment));
    for (size_t k = 0; k < 3; ++k) {
      out[6 * side + k] = force[static_cast<Eigen::Index>(k)];
      out[6 * side + 3 + k] = moment[static_cast<Eigen::Index>(k)];
    }
  }
  return out;
}

bool has_arms(const Motion& motion) { return listed_joint_count(motion) == kJointCount; }

struct C3dShape {
  size_t joints, angles, channels, frames;
  size_t points() const { return joints + angles; }
};

C3dShape shape_of(const C3dContent& content) {
  return {static_cast<size_t>(has_arms(content.motion) ? kJointCount : kJointCountWithoutArms),
          content.angles.empty() ? 0 : kTriples.size(), content.kinetics ? kChannelCount : 0,
          content.motion.time.size()};
}

C3dGroup point_group(const C3dContent& content, const C3dShape& shape, int data_start) {
  C3dGroup group{"POINT", "joint centres and angles"};
  std::vector<std::string> labels(kJointNames.begin(), kJointNames.begin() + shape.joints),
      descriptions(kDescriptions.begin(), kDescriptions.begin() + shape.joints), angles;
  for (size_t k = 0; k < shape.angles; ++k) {
    angles.emplace_back(kTriples[k].label);
    labels.emplace_back(kTriples[k].label);
    descriptions.emplace_back(kTriples[k].description);
  }
  group.whole("USED", static_cast<int>(labels.size()));
  group.whole("FRAMES", static_cast<int>(std::min<size_t>(shape.frames, kMostInHeader)));
  group.real("LONG_FRAMES", static_cast<double>(shape.frames));
  group.whole("DATA_START", data_start);
  group.real("SCALE", -1);  // negative: the data are floats
  group.real("RATE", content.rate);
  group.text("X_SCREEN", "+X");
  group.text("Y_SCREEN", "+Z");
  group.text("UNITS", "mm");
  group.texts("LABELS", labels);
  group.texts("DESCRIPTIONS", descriptions);
  if (!angles.empty()) {
    group.text("ANGLE_UNITS", "deg");
    group.texts("ANGLES", angles);
  }
  return group;
}

C3dGroup analog_group(const C3dContent& content, const C3dShape& shape) {
  C3dGroup group{"ANALOG", "ground reactions, computed from the motion"};
  group.whole("USED", static_cast<int>(shape.channels));
  group.real("GEN_SCALE", 1);
  group.real("RATE", content.rate);
  group.text("FORMAT", "SIGNED");
  group.whole("BITS", 16);
  if (shape.channels == 0) return group;
  std::vector<std::string> labels, descriptions, units;
  for (const std::string& foot : {std::string("left"), std::string("right")})
    for (size_t k = 0; k < kChannels.size(); ++k) {
      labels.push_back(std::string(kChannels[k]) + (foot == "left" ? "1" : "2"));
      descriptions.push_back(foot + " foot, computed");
      units.emplace_back(k < 3 ? "N" : "Nmm");
    }
  group.texts("LABELS", labels);
  group.texts("DESCRIPTIONS", descriptions);
  group.texts("UNITS", units);
  group.reals("SCALE", std::vector<double>(kChannelCount, 1));
  group.wholes("OFFSET", std::vector<int>(kChannelCount, 0));
  return group;
}

C3dGroup plate_group(const C3dContent& content, const C3dShape& shape) {
  C3dGroup group{"FORCE_PLATFORM", "no plates: under the left and the right foot, computed"};
  const int plates = shape.channels > 0 ? static_cast<int>(kFeet.size()) : 0;
  group.whole("USED", plates);
  group.wholes("ZERO", std::array{0, 0});
  if (plates == 0) return group;
  const Plate plate = plate_under(content.motion);
  const double x0 = kMmPerM * plate.low.x(), x1 = kMmPerM * plate.high.x(),
               y0 = kMmPerM * plate.low.y(), y1 = kMmPerM * plate.high.y();
  std::vector<double> corners;
  std::vector<int> channels;
  for (int k = 0; k < static_cast<int>(kChannelCount); ++k) channels.push_back(k + 1);
  // The corners in the quadrants +x+y, -x+y, -x-y, +x-y of the plate's axes, whose y is the world's
  // -y.
  for (int p = 0; p < plates; ++p)
    for (const double each : {x1, y0, 0., x0, y0, 0., x0, y1, 0., x1, y1, 0.})
      corners.push_back(each);
  group.wholes("TYPE", std::array{2, 2});
  group.reals("CORNERS", corners, {3, 4});
  group.reals("ORIGIN", std::vector<double>(6, 0), {3});
  group.wholes("CHANNEL", channels, {6});
  group.texts("DESCRIPTIONS", std::vector<std::string>{"left foot", "right foot"});
  group.text("UNITS", "N");
  return group;
}

C3dGroup event_group(const C3dContent& content) {
  C3dGroup group{"EVENT", "heel strikes and toe-offs"};
  const auto events = content.events.first(std::min(content.events.size(), kMostEvents));
  std::vector<std::string> contexts, labels, subjects;
  std::vector<double> times;
  std::vector<int> icons;
  for (const GaitEvent& event : events) {
    const bool strike = event.kind == GaitEventKind::kFootStrike;
    const double time = std::max(0.0, event.time - content.motion.time.front());
    contexts.emplace_back(event.side == Side::kLeft ? "Left" : "Right");
    labels.emplace_back(strike ? "Foot Strike" : "Foot Off");
    subjects.emplace_back("walker");
    icons.push_back(strike ? 1 : 2);
    times.push_back(std::floor(time / 60));
    times.push_back(time - 60 * times.back());
  }
  group.whole("USED", static_cast<int>(events.size()));
  if (events.empty()) return group;
  group.texts("CONTEXTS", contexts);
  group.texts("LABELS", labels);
  group.texts("SUBJECTS", subjects);
  group.wholes("ICON_IDS", icons);
  group.reals("TIMES", times, {2});
  return group;
}

C3dGroup context_group() {
  C3dGroup group{"EVENT_CONTEXT", "sides of events"};
  group.whole("USED", 2);
  group.wholes("ICON_IDS", std::array{0, 1});
  group.texts("LABELS", std::vector<std::string>{"Left", "Right"});
  return group;
}

C3dGroup trial_group(const C3dShape& shape) {
  C3dGroup group{"TRIAL", "frames"};
  const int frames = static_cast<int>(shape.frames);
  group.wholes("ACTUAL_START_FIELD", std::array{1, 0});
  group.wholes("ACTUAL_END_FIELD", std::array{frames & 0xffff, frames >> 16});
  return group;
}

C3dGroup subject_group() {
  C3dGroup group{"SUBJECTS", ""};
  group.whole("USED", 1);
  group.whole("USES_PREFIXES", 0);
  group.texts("NAMES", std::vector<std::string>{"walker"});
  return group;
}

C3dGroup maker_group() {
  C3dGroup group{"MANUFACTURER", ""};
  group.text("COMPANY", "walktrack");
  group.text("SOFTWARE", "walktrack");
  group.text("VERSION_LABEL", build_facts().version);
  return group;
}

std::string parameters_of(const C3dContent& content, const C3dShape& shape, int data_start) {
  return c3d_parameter_section(std::array{point_group(content, shape, data_start),
                                          analog_group(content, shape), plate_group(content, shape),
                                          event_group(content), context_group(), trial_group(shape),
                                          subject_group(), maker_group()});
}

std::string header(const C3dContent& content, const C3dShape& shape, int data_start) {
  const int frames = static_cast<int>(std::min<size_t>(shape.frames, kMostInHeader));
  std::string bytes{2, 0x50};  // the block number of the parameters, then the format's key 0x50
  append_c3d_whole(bytes, static_cast<int>(shape.points()));
  append_c3d_whole(bytes, static_cast<int>(shape.channels));  // analog values in each frame
  append_c3d_whole(bytes, 1);
  append_c3d_whole(bytes, frames);
  append_c3d_whole(bytes, 0);  // longest gap that was interpolated
  append_c3d_real(bytes, -1);  // scale
  append_c3d_whole(bytes, data_start);
  append_c3d_whole(bytes, shape.channels > 0 ? 1 : 0);  // analog samples in each frame
  append_c3d_real(bytes, content.rate);
  bytes.resize(kC3dBlock, '\0');
  return bytes;
}

void append_point(std::string& bytes, const Eigen::Vector3d& point) {
  const bool is_known = point.allFinite();
  for (const double each : is_known ? point : Eigen::Vector3d::Zero().eval())
    append_c3d_real(bytes, each);
  append_c3d_real(bytes, is_known ? 0 : -1);
}

void append_angles(std::string& bytes, const AngleRow& row) {
  std::optional<JointAngles> angles;
  if (row.pose) angles = joint_angles(*row.pose);
  for (const AngleTriple& triple : kTriples) {
    Eigen::Vector3d point = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
    for (size_t k = 0; angles && k < 3; ++k)
      point[static_cast<Eigen::Index>(k)] =
          triple.of[k] == kJointAngleCount ? 0
                                           : triple.sign[k] * deg_from_rad((*angles)[triple.of[k]]);
    append_point(bytes, point);
  }
}

}  // namespace

std::string c3d_from_motion(const C3dContent& content) {
  const C3dShape shape = shape_of(content);
  const size_t blocks = parameters_of(content, shape, 0).size() / kC3dBlock;
  const int data_start = 2 + static_cast<int>(blocks);
  std::string bytes = header(content, shape, data_start);
  bytes += parameters_of(content, shape, data_start);
  const Plate plate = plate_under(content.motion);
  for (size_t i = 0; i < shape.frames; ++i) {
    for (size_t joint = 0; joint < shape.joints; ++joint)
      append_point(bytes, kMmPerM * content.motion.joints[i].at[joint]);
    if (shape.angles > 0) append_angles(bytes, content.angles[i]);
    if (shape.channels > 0)
      for (const double each : channels_of(content.kinetics->frames[i], plate))
        append_c3d_real(bytes, each);
  }
  bytes.resize((bytes.size() + kC3dBlock - 1) / kC3dBlock * kC3dBlock, '\0');
  return bytes;
}

}  // namespace io
}  // namespace walktrack
