#include "body/kinematics.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include "core/conventions.h"

namespace walktrack {
inline namespace body {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// clang-format off
Matrix3d rotation_x(double a) {
  const double c = std::cos(a), s = std::sin(a);
  Matrix3d r;
  r << 1, 0,  0,
       0, c, -s,
       0, s,  c;
  return r;
}

Matrix3d rotation_y(double a) {
  const double c = std::cos(a), s = std::sin(a);
  Matrix3d r;
  r <<  c, 0, s,
        0, 1, 0,
       -s, 0, c;
  return r;
}

Matrix3d rotation_z(double a) {
  const double c = std::cos(a), s = std::sin(a);
  Matrix3d r;
  r << c, -s, 0,
       s,  c, 0,
       0,  0, 1;
  return r;
}
// clang-format on

// The sign of y on that side of the body.
size_t index(Side side) { return static_cast<size_t>(side); }

Matrix3d pelvis_from_thigh(const LegPose& leg, Side side) {
  return rotation_x(outward(side) * leg.hip_abduction) * rotation_y(-leg.hip_flexion) *
         rotation_z(-outward(side) * leg.hip_rotation);
}

struct SideSegments {
  Segment thigh, shank, foot, upper_arm, forearm;
  Joint shoulder, elbow, wrist;
};

SideSegments segments(Side side) {
  if (side == Side::kLeft)
    return {Segment::kLeftThigh,   Segment::kLeftShank,  Segment::kLeftFoot, Segment::kLeftUpperArm,
            Segment::kLeftForearm, Joint::kLeftShoulder, Joint::kLeftElbow,  Joint::kLeftWrist};
  return {Segment::kRightThigh,    Segment::kRightShank,   Segment::kRightFoot,
          Segment::kRightUpperArm, Segment::kRightForearm, Joint::kRightShoulder,
          Joint::kRightElbow,      Joint::kRightWrist};
}

Vector3d hip_offset(const Body& body, Side side) {
  return {0, outward(side) * 0.5 * body.lengths.hip_width, 0};
}

void place_leg(const Body& body, const Pose& pose, Side side, Skeleton& out) {
  const LegPose& leg = pose.legs[index(side)];
  const BodyLengths& l = body.lengths;
  const SideSegments s = segments(side);
  const auto axes = [&](Segment name) -> Matrix3d& {
    return out.world_from_segment[static_cast<size_t>(name)];
  };
  axes(s.thigh) = out.axes(Segment::kPelvis) * pelvis_from_thigh(leg, side);
  axes(s.shank) = axes(s.thigh) * rotation_y(leg.knee_flexion);
  axes(s.foot) = axes(s.shank) * rotation_y(-leg.ankle_dorsiflexion);
  JointPositions& j = out.joints;
  j[hip(side)] = pose.root + out.axes(Segment::kPelvis) * hip_offset(body, side);
  j[knee(side)] = j[hip(side)] - l.thigh * axes(s.thigh).col(2);
  j[ankle(side)] = j[knee(side)] - l.shank * axes(s.shank).col(2);
  j[toe(side)] =
      j[ankle(side)] + axes(s.foot) * Vector3d(l.ball_forward, 0, l.ball_height - l.ankle_height);
}

void place_arm(const Body& body, const Pose& pose, Side side, Skeleton& out) {
  const ArmPose& arm = pose.arms[index(side)];
  const BodyLengths& l = body.lengths;
  const SideSegments s = segments(side);
  const Matrix3d& trunk = out.axes(Segment::kTrunk);
  Matrix3d& upper = out.world_from_segment[static_cast<size_t>(s.upper_arm)];
  Matrix3d& fore = out.world_from_segment[static_cast<size_t>(s.forearm)];
  upper = trunk * rotation_x(outward(side) * arm.shoulder_abduction) *
          rotation_y(-arm.shoulder_flexion);
  fore = upper * rotation_y(-arm.elbow_flexion);
  JointPositions& j = out.joints;
  j[s.shoulder] = pose.root + trunk * Vector3d(0, outward(side) * 0.5 * l.shoulder_width, l.trunk);
  j[s.elbow] = j[s.shoulder] - l.upper_arm * upper.col(2);
  j[s.wrist] = j[s.elbow] - l.forearm * fore.col(2);
}

}  // namespace

Matrix3d world_from_pelvis(const Pose& pose) {
  return rotation_z(pose.heading) * rotation_x(pose.list) * rotation_y(pose.tilt);
}

Skeleton forward_kinematics(const Body& body, const Pose& pose) {
  Skeleton out;
  const Matrix3d trunk = rotation_z(pose.heading) * rotation_y(pose.tilt);
  out.world_from_segment[static_cast<size_t>(Segment::kPelvis)] = world_from_pelvis(pose);
  out.world_from_segment[static_cast<size_t>(Segment::kTrunk)] = trunk;
  out.joints[Joint::kPelvis] = pose.root;
  out.joints[Joint::kNeck] = pose.root + body.lengths.neck * trunk.col(2);
  out.joints[Joint::kHead] = pose.root + body.lengths.head * trunk.col(2);
  for (const Side side : {Side::kLeft, Side::kRight}) {
    place_leg(body, pose, side, out);
    if (body.groups.arms) place_arm(body, pose, side, out);
  }
  return out;
}

void PosedParts::push_back(const PosedPart& part) {
  if (size_ == items_.size()) throw std::length_error("more parts than kMaxParts");
  items_[size_++] = part;
}

PosedParts pose_parts(const Body& body, const Skeleton& skeleton) {
  PosedParts out;
  for (const Part& part : body.parts) {
    const Matrix3d& axes = skeleton.axes(part.segment);
    const Vector3d& origin = skeleton.joints[part.origin];
    const bool lies = part.appearance == Appearance::kFeet;
    out.push_back({origin + axes * part.lower, origin + axes * part.upper, axes.col(1),
                   lies ? axes.col(2) : axes.col(0), part.at_lower, part.at_upper,
                   part.appearance});
  }
  return out;
}

Vector3d ankle_from_root(const Body& body, const Pose& pose, Side side) {
  const LegPose& leg = pose.legs[index(side)];
  const Matrix3d pelvis = world_from_pelvis(pose);
  const Matrix3d thigh = pelvis * pelvis_from_thigh(leg, side);
  const Vector3d shank_up(std::sin(leg.knee_flexion), 0, std::cos(leg.knee_flexion));
  return pelvis * hip_offset(body, side) -
         thigh * (body.lengths.thigh * Vector3d::UnitZ() + body.lengths.shank * shank_up);
}

Eigen::Vector2d ankle_from_ball(const BodyLengths& lengths, double pitch) {
  const double c = std::cos(pitch), s = std::sin(pitch);
  return {-lengths.ball_forward * c + lengths.ankle_height * s,
          lengths.ball_forward * s + lengths.ankle_height * c};
}

double sole_pitch(const BodyLengths& lengths, const Eigen::Vector2d& ankle_from_ball) {
  return std::atan2(ankle_from_ball.y(), -ankle_from_ball.x()) -
         std::atan2(lengths.ankle_height, lengths.ball_forward);
}

void stand_on(const Body& body, Side side, const Vector3d& ball,
              const Eigen::Vector2d& ankle_from_ball, Pose& pose) {
  // The foot points forward in the plane of the leg, i.e. the heading rotated by the hip's
  // rotation.
  LegPose& leg = pose.legs[index(side)];
  const double toes = pose.heading - outward(side) * leg.hip_rotation;
  const Vector3d ankle_world =
      ball + Vector3d(ankle_from_ball.x() * std::cos(toes), ankle_from_ball.x() * std::sin(toes),
                      ankle_from_ball.y());
  pose.root = ankle_world - ankle_from_root(body, pose, side);
  leg.ankle_dorsiflexion =
      pose.tilt - leg.hip_flexion + leg.knee_flexion - sole_pitch(body.lengths, ankle_from_ball);
}

}  // namespace body
}  // namespace walktrack
