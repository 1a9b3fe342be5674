#include "synth/world/figure.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "body/axes.h"
#include "body/pose_from_joints.h"
#include "core/errors.h"

namespace walktrack {
inline namespace synth {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kHingeWeight = 0.3;  // weight of the trunk's left axis relative to a bent elbow's
                                      // own axis

// Axes of a foot with x along the sole. The ball's height below the ankle is the body's, so that
// the line from ankle to ball is rotated by its angle to the sole.
Matrix3d foot_axes(const Body& body, const Vector3d& ankle_to_ball, const Vector3d& left) {
  const double drop = body.lengths.ankle_height - body.lengths.ball_height;
  const double reach = ankle_to_ball.norm();
  const double below = std::asin(std::clamp(drop / reach, -1.0, 1.0));
  return axes_with_x(ankle_to_ball, left) *
         Eigen::AngleAxisd(-below, Vector3d::UnitY()).toRotationMatrix();
}

struct LegSegments {
  Segment thigh, shank, foot;
};
struct ArmSegments {
  Segment upper, fore;
  Joint shoulder, elbow, wrist;
};

LegSegments leg_segments(Side side) {
  if (side == Side::kLeft) return {Segment::kLeftThigh, Segment::kLeftShank, Segment::kLeftFoot};
  return {Segment::kRightThigh, Segment::kRightShank, Segment::kRightFoot};
}

ArmSegments arm_segments(Side side) {
  if (side == Side::kLeft)
    return {Segment::kLeftUpperArm, Segment::kLeftForearm, Joint::kLeftShoulder, Joint::kLeftElbow,
            Joint::kLeftWrist};
  return {Segment::kRightUpperArm, Segment::kRightForearm, Joint::kRightShoulder,
          Joint::kRightElbow, Joint::kRightWrist};
}

Matrix3d& axes_of(Skeleton& skeleton, Segment segment) {
  return skeleton.world_from_segment[static_cast<size_t>(segment)];
}

void set_leg(const Body& body, const JointPositions& joints, Side side, const Vector3d& left,
             Skeleton& out) {
  const LegSegments s = leg_segments(side);
  const Vector3d hinge = leg_hinge_axis(joints, side, left);
  axes_of(out, s.thigh) = axes_with_z(joints[hip(side)] - joints[knee(side)], hinge);
  axes_of(out, s.shank) = axes_with_z(joints[knee(side)] - joints[ankle(side)], hinge);
  const Vector3d ball = joints[toe(side)] - joints[ankle(side)];
  axes_of(out, s.foot) =
      known(ball) ? foot_axes(body, ball, hinge) : axes_with_z(Vector3d::UnitZ(), left);
}

bool set_arm(const JointPositions& joints, Side side, const Vector3d& left, Skeleton& out) {
  const ArmSegments s = arm_segments(side);
  const Vector3d upper = joints[s.shoulder] - joints[s.elbow];
  const Vector3d fore = joints[s.elbow] - joints[s.wrist];
  if (!known(upper) || !known(fore)) return false;
  // Elbows flex forwards, about the right-pointing axis.
  const Vector3d bend = fore.normalized().cross(upper.normalized());
  const Vector3d hinge = bend + kHingeWeight * left;
  axes_of(out, s.upper) = axes_with_z(upper, hinge);
  axes_of(out, s.fore) = axes_with_z(fore, hinge);
  return true;
}

Vector3d trunk_left(const JointPositions& joints, const Vector3d& hips_left) {
  const Vector3d shoulders = joints[Joint::kLeftShoulder] - joints[Joint::kRightShoulder];
  return known(shoulders) ? Vector3d(hips_left + shoulders.normalized()) : hips_left;
}

// Median of a length over the rows in which it is known.
std::optional<double> median_length(const Motion& motion, Joint from, Joint to) {
  std::vector<double> lengths;
  for (const JointPositions& joints : motion.joints) {
    const Vector3d bone = joints[to] - joints[from];
    if (known(bone)) lengths.push_back(bone.norm());
  }
  if (lengths.empty()) return std::nullopt;
  const auto middle = lengths.begin() + static_cast<std::ptrdiff_t>(lengths.size() / 2);
  std::nth_element(lengths.begin(), middle, lengths.end());
  return *middle;
}

double mean_of_sides(const Motion& motion, Joint (*from)(Side), Joint (*to)(Side)) {
  double sum = 0;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const auto length = median_length(motion, from(side), to(side));
    if (!length) throw InputError("the motion never knows both hips, knees and ankles");
    sum += 0.5 * *length;
  }
  return sum;
}

Material cloth(float red, float green, float blue, Pattern pattern, double size) {
  const Colour colour(red, green, blue);
  return {colour, 0.62f * colour, pattern, size};
}

}  // namespace

Clothes clothes(int index) {
  const Material skin = cloth(0.82f, 0.62f, 0.5f, Pattern::kPlain, 0.08);
  const Material shoes = cloth(0.16f, 0.14f, 0.15f, Pattern::kPlain, 0.05);
  constexpr int kSets = 4;
  switch (((index % kSets) + kSets) % kSets) {
    case 0:
      return {cloth(0.75f, 0.16f, 0.14f, Pattern::kStripes, 0.05),
              cloth(0.16f, 0.22f, 0.42f, Pattern::kMottled, 0.05), shoes, skin, skin};
    case 1:
      return {cloth(0.16f, 0.42f, 0.3f, Pattern::kChecks, 0.06),
              cloth(0.3f, 0.28f, 0.26f, Pattern::kMottled, 0.06), shoes, skin, skin};
    case 2:
      return {cloth(0.88f, 0.86f, 0.8f, Pattern::kMottled, 0.1),
              cloth(0.12f, 0.12f, 0.14f, Pattern::kMottled, 0.06),
              cloth(0.8f, 0.8f, 0.82f, Pattern::kPlain, 0.05), skin, skin};
    default:
      return {cloth(0.2f, 0.3f, 0.65f, Pattern::kMottled, 0.08),
              cloth(0.62f, 0.55f, 0.4f, Pattern::kMottled, 0.06), shoes, skin, skin};
  }
}

Body body_from_motion(const Motion& motion, double height) {
  Subject subject;
  subject.height = height;
  const BodyLengths usual = body_lengths(subject);
  subject.lengths.thigh = mean_of_sides(motion, hip, knee);
  subject.lengths.shank = mean_of_sides(motion, knee, ankle);
  subject.lengths.hip_width = median_length(motion, Joint::kLeftHip, Joint::kRightHip);
  if (const auto neck = median_length(motion, Joint::kPelvis, Joint::kNeck))
    subject.lengths.trunk = *neck - (usual.neck - usual.trunk);
  const ArmSegments arm = arm_segments(Side::kLeft);
  subject.lengths.shoulder_width =
      median_length(motion, Joint::kLeftShoulder, Joint::kRightShoulder);
  subject.lengths.upper_arm = median_length(motion, arm.shoulder, arm.elbow);
  subject.lengths.forearm = median_length(motion, arm.elbow, arm.wrist);
  return make_body(subject, {.head = true, .arms = subject.lengths.forearm.has_value()});
}

std::optional<Skeleton> skeleton_from_joints(const Body& body, const JointPositions& joints) {
  Skeleton out;
  out.joints = joints;
  const Vector3d left = (joints[Joint::kLeftHip] - joints[Joint::kRightHip]).normalized();
  if (!known(left)) return std::nullopt;
  out.joints[Joint::kPelvis] = 0.5 * (joints[Joint::kLeftHip] + joints[Joint::kRightHip]);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    if (!known(joints[knee(side)]) || !known(joints[ankle(side)])) return std::nullopt;
    set_leg(body, joints, side, left, out);
    if (body.groups.arms && !set_arm(joints, side, left, out)) return std::nullopt;
  }
  const Vector3d spine = joints[Joint::kNeck] - out.joints[Joint::kPelvis];
  const Vector3d up = known(spine) ? spine : Vector3d(Vector3d::UnitZ());
  axes_of(out, Segment::kTrunk) = axes_with_z(up, trunk_left(joints, left));
  // The pelvis keeps its own left axis: the trunk's direction determines its tilt, the hips its
  // list.
  Matrix3d& pelvis = axes_of(out, Segment::kPelvis);
  pelvis.col(1) = left;
  pelvis.col(0) = left.cross(up).normalized();
  pelvis.col(2) = pelvis.col(0).cross(left);
  return out;
}

}  // namespace synth
}  // namespace walktrack
