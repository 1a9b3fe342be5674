#include "kinetics/linked_body.h"

#include <algorithm>
#include <array>
#include <stdexcept>

#include <Eigen/Geometry>

#include "body/axes.h"
#include "body/pose_from_joints.h"
#include "core/anthropometry.h"

namespace walktrack {
inline namespace kinetics {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

// Shares of the subject's mass (of the stature: heights and lengths). The trunk is thorax and
// abdomen, with its centre such that the centre of trunk and pelvis together is half way up to the
// shoulders. The length of the whole arm is that to the wrist.
constexpr double kPelvisMass = .142, kTrunkMass = .355, kHeadMass = .081;
constexpr double kPelvisHeight = .063, kTrunkHeight = .1764, kHeadHeight = .405;
constexpr double kArmLength = .332;
using anthropometry::kWholeArm;

bool has_arms(std::span<const JointPositions> joints) {
  for (const JointPositions& row : joints)
    for (size_t j = kJointCountWithoutArms; j < kJointCount; ++j)
      if (!known(row.at[j])) return false;
  return true;
}

Vector3d top_of_trunk(const JointPositions& joints) {
  return known(joints[Joint::kNeck]) ? joints[Joint::kNeck] : joints[Joint::kHead];
}

// From shoulder to shoulder if they are known, because trunks rotate and lean relative to pelvises.
Vector3d left_of_trunk(const JointPositions& joints) {
  const Vector3d left = joints[Joint::kLeftShoulder] - joints[Joint::kRightShoulder];
  return known(left) ? left : Vector3d(joints[Joint::kLeftHip] - joints[Joint::kRightHip]);
}

// The pelvis keeps its own left axis exactly, the trunk its own up axis.
Matrix3d pelvis_frame(const JointPositions& joints) {
  const Vector3d left = (joints[Joint::kLeftHip] - joints[Joint::kRightHip]).normalized();
  const Vector3d up = top_of_trunk(joints) - joints[Joint::kPelvis];
  return axes_with_z(up - left * left.dot(up), left);
}

struct ArmJoints {
  Joint shoulder, elbow, wrist;
};
ArmJoints arm_joints(Side side) {
  if (side == Side::kLeft) return {Joint::kLeftShoulder, Joint::kLeftElbow, Joint::kLeftWrist};
  return {Joint::kRightShoulder, Joint::kRightElbow, Joint::kRightWrist};
}

Matrix3d link_axes(const JointPositions& joints, Segment segment) {
  const Vector3d left = joints[Joint::kLeftHip] - joints[Joint::kRightHip];
  const auto leg_axis = [&](Side side) {
    return leg_hinge_axis(joints, side, pelvis_frame(joints).col(1));
  };
  const auto along = [&](Joint top, Joint bottom, const Vector3d& sideways) {
    return axes_with_z(joints[top] - joints[bottom], sideways);
  };
  const auto foot = [&](Side side) {
    return axes_with_x(joints[toe(side)] - joints[ankle(side)], leg_axis(side));
  };
  const Side side = segment == Segment::kLeftThigh || segment == Segment::kLeftShank ||
                            segment == Segment::kLeftFoot || segment == Segment::kLeftUpperArm ||
                            segment == Segment::kLeftForearm
                        ? Side::kLeft
                        : Side::kRight;
  const ArmJoints arm = arm_joints(side);
  switch (segment) {
    case Segment::kPelvis:
      return pelvis_frame(joints);
    case Segment::kTrunk:
      return axes_with_z(top_of_trunk(joints) - joints[Joint::kPelvis], left_of_trunk(joints));
    case Segment::kLeftThigh:
    case Segment::kRightThigh:
      return along(hip(side), knee(side), leg_axis(side));
    case Segment::kLeftShank:
    case Segment::kRightShank:
      return along(knee(side), ankle(side), leg_axis(side));
    case Segment::kLeftFoot:
    case Segment::kRightFoot:
      return foot(side);
    case Segment::kLeftUpperArm:
    case Segment::kRightUpperArm:
      return along(arm.shoulder, arm.elbow, left);
    case Segment::kLeftForearm:
    case Segment::kRightForearm:
      break;
  }
  return along(arm.elbow, arm.wrist, left);
}

// `solid`, scaled to `mass` and moved so that its centre is at `centre`.
MassProperties weighing(const MassProperties& solid, double mass, const Vector3d& centre) {
  return {mass, centre, solid.inertia * (mass / solid.mass)};
}

// A rod-like limb: `radius` of gyration about axes across it; about its own axis, about which
// walking hardly rotates it, that of a cylinder a quarter as wide as long.
MassProperties limb(double mass, double length, const Vector3d& centre, double radius,
                    Eigen::Index axis) {
  MassProperties out{mass, centre, Matrix3d::Zero()};
  out.inertia.diagonal().setConstant(mass * radius * radius);
  out.inertia(axis, axis) = mass * length * length / 128;
  return out;
}

MassProperties pelvis_mass(const Subject& subject) {
  const double h = subject.height;
  const MassProperties solid = elliptic_frustum(1, .10 * h, Eigen::Vector2d(.068, .093) * h,
                                                Eigen::Vector2d(.065, .090) * h);
  return weighing(solid, kPelvisMass * subject.mass, {0, 0, kPelvisHeight * h});
}

MassProperties trunk_mass(const Subject& subject, bool with_arms) {
  const double h = subject.height, m = subject.mass;
  const MassProperties torso = elliptic_frustum(1, .23 * h, Eigen::Vector2d(.062, .084) * h,
                                                Eigen::Vector2d(.060, .088) * h);
  std::vector<MassProperties> solids{weighing(torso, kTrunkMass * m, {0, 0, kTrunkHeight * h}),
                                     weighing(ellipsoid(1, Vector3d(.056, .043, .065) * h),
                                              kHeadMass * m, {0, 0, kHeadHeight * h})};
  const BodyLengths lengths = body_lengths(subject);
  for (const double side : {0.5, -0.5}) {
    if (!with_arms) break;
    const Vector3d centre(0, side * lengths.shoulder_width,
                          lengths.trunk - kWholeArm.centre * kArmLength * h);
    solids.push_back(
        limb(kWholeArm.mass * m, kArmLength * h, centre, kWholeArm.gyration * kArmLength * h, 2));
  }
  return combined(solids);
}

struct Limb {
  Segment segment, parent;
  Joint origin, end;
  anthropometry::SegmentShares shares;
};

void add_legs(Side side, std::vector<Limb>& limbs) {
  const bool left = side == Side::kLeft;
  const Segment thigh = left ? Segment::kLeftThigh : Segment::kRightThigh;
  const Segment shank = left ? Segment::kLeftShank : Segment::kRightShank;
  const Segment foot = left ? Segment::kLeftFoot : Segment::kRightFoot;
  limbs.push_back({thigh, Segment::kPelvis, hip(side), knee(side), anthropometry::kThighShares});
  limbs.push_back({shank, thigh, knee(side), ankle(side), anthropometry::kShankShares});
  limbs.push_back({foot, shank, ankle(side), toe(side), anthropometry::kFootShares});
}

// Forearm and hand: .682 of the forearm's length from the elbow, radius .468.
void add_arms(Side side, std::vector<Limb>& limbs) {
  const bool left = side == Side::kLeft;
  const ArmJoints arm = arm_joints(side);
  const Segment upper = left ? Segment::kLeftUpperArm : Segment::kRightUpperArm;
  const Segment fore = left ? Segment::kLeftForearm : Segment::kRightForearm;
  limbs.push_back(
      {upper, Segment::kTrunk, arm.shoulder, arm.elbow, anthropometry::kUpperArmShares});
  limbs.push_back({fore, upper, arm.elbow, arm.wrist, anthropometry::kForearmAndHand});
}

bool is_foot(Segment segment) {
  return segment == Segment::kLeftFoot || segment == Segment::kRightFoot;
}

// Mean over the rows of `point` in the axes of a link.
Vector3d mean_place(std::span<const JointPositions> rows, const Link& link, Joint point) {
  Vector3d sum = Vector3d::Zero();
  for (const JointPositions& joints : rows)
    sum += link_axes(joints, link.segment).transpose() * (joints[point] - joints[link.origin]);
  return sum / static_cast<double>(rows.size());
}

double mean_length(std::span<const JointPositions> rows, Joint from, Joint to) {
  double sum = 0;
  for (const JointPositions& joints : rows) sum += (joints[to] - joints[from]).norm();
  return sum / static_cast<double>(rows.size());
}

MassProperties limb_mass(const Limb& each, const Subject& subject,
                         std::span<const JointPositions> rows) {
  const double length = mean_length(rows, each.origin, each.end);
  const bool foot = is_foot(each.segment);
  const Vector3d way = foot ? Vector3d::UnitX() : Vector3d(-Vector3d::UnitZ());
  return limb(each.shares.mass * subject.mass, length, each.shares.centre * length * way,
              each.shares.gyration * length, foot ? 0 : 2);
}

size_t index_of(const std::vector<Link>& links, Segment segment) {
  const auto found = std::find_if(links.begin(), links.end(),
                                  [&](const Link& link) { return link.segment == segment; });
  if (found == links.end()) throw std::invalid_argument("no such link");
  return static_cast<size_t>(found - links.begin());
}

// Rotation vector from one orientation to another, in the axes of either.
Vector3d turn(const Matrix3d& from, const Matrix3d& to) {
  const Eigen::AngleAxisd rotation(from.transpose() * to);
  return rotation.angle() * rotation.axis();
}

// Every link's orientation relative to its parent's; the root's relative to the world.
std::vector<Matrix3d> joint_rotations(const LinkedBody& body, const JointPositions& joints) {
  std::vector<Matrix3d> world, out;
  for (const Link& link : body.links) world.push_back(link_axes(joints, link.segment));
  for (size_t k = 0; k < world.size(); ++k) {
    const int parent = body.tree.parts()[k].parent;
    out.push_back(parent < 0 ? world[k]
                             : Matrix3d(world[static_cast<size_t>(parent)].transpose() * world[k]));
  }
  return out;
}

void set_rates(const LinkedBody& body, std::span<const JointPositions> joints,
               const std::vector<std::vector<Matrix3d>>& rotations, size_t i, double dt,
               LinkedState& state) {
  const Vector3d &before = joints[i - 1][Joint::kPelvis], &now = joints[i][Joint::kPelvis],
                 &after = joints[i + 1][Joint::kPelvis];
  state.u = state.u_dot = Eigen::VectorXd::Zero(body.tree.velocities());
  state.u.head<3>() = (after - before) / (2 * dt);
  state.u_dot.head<3>() = (after - 2 * now + before) / (dt * dt);
  for (size_t k = 0; k < body.links.size(); ++k) {
    const Eigen::Index at = k == 0 ? 3 : body.tree.velocity_index(k);
    const Vector3d first = turn(rotations[i - 1][k], rotations[i][k]);
    const Vector3d second = turn(rotations[i][k], rotations[i + 1][k]);
    state.u.segment<3>(at) = (first + second) / (2 * dt);
    state.u_dot.segment<3>(at) = (second - first) / (dt * dt);
  }
}

}  // namespace

size_t LinkedBody::index(Segment segment) const { return index_of(links, segment); }

bool linkable(const JointPositions& joints) {
  if (!known(joints[Joint::kPelvis]) || !known(top_of_trunk(joints))) return false;
  for (const Side side : {Side::kLeft, Side::kRight})
    for (const Joint joint : {hip(side), knee(side), ankle(side), toe(side)})
      if (!known(joints[joint])) return false;
  return true;
}

LinkedBody linked_body(const Subject& subject, std::span<const JointPositions> joints) {
  const bool arms = has_arms(joints);
  std::vector<Limb> limbs;
  for (const Side side : {Side::kLeft, Side::kRight}) add_legs(side, limbs);
  for (const Side side : {Side::kLeft, Side::kRight})
    if (arms) add_arms(side, limbs);
  std::vector<Link> links{{Segment::kPelvis, Joint::kPelvis}, {Segment::kTrunk, Joint::kPelvis}};
  std::vector<ArticulatedPart> parts(2);
  parts[0].mass = pelvis_mass(subject);
  parts[1] = {.mass = trunk_mass(subject, !arms), .parent = 0, .joint = JointKind::kBall};
  for (const Limb& each : limbs) {
    const size_t parent = index_of(links, each.parent);
    parts.push_back({.mass = limb_mass(each, subject, joints),
                     .parent = static_cast<int>(parent),
                     .joint = JointKind::kBall,
                     .anchor = mean_place(joints, links[parent], each.origin)});
    links.push_back({each.segment, each.origin});
  }
  return {ArticulatedBody(std::move(parts)), std::move(links)};
}

std::vector<LinkedState> linked_states(const LinkedBody& body,
                                       std::span<const JointPositions> joints, double dt) {
  if (joints.size() < 3) throw std::invalid_argument("derivatives need three rows");
  std::vector<std::vector<Matrix3d>> rotations;
  for (const JointPositions& row : joints) rotations.push_back(joint_rotations(body, row));
  std::vector<LinkedState> out(joints.size());
  for (size_t i = 0; i < joints.size(); ++i) {
    out[i].q = body.tree.zero_positions();
    out[i].q.head<3>() = joints[i][Joint::kPelvis];
    for (size_t k = 0; k < body.links.size(); ++k) {
      const Eigen::Index at = k == 0 ? 3 : body.tree.position_index(k);
      out[i].q.segment<4>(at) = quaternion_from_rotation(rotations[i][k]);
    }
    if (i > 0 && i + 1 < joints.size()) set_rates(body, joints, rotations, i, dt, out[i]);
  }
  const auto copy_rates = [&](size_t from, size_t to) {
    out[to].u = out[from].u;
    out[to].u_dot = out[from].u_dot;
  };
  copy_rates(1, 0);
  copy_rates(out.size() - 2, out.size() - 1);
  return out;
}

}  // namespace kinetics
}  // namespace walktrack
