// The inverse of forward kinematics: the angles of a pose from joint centres alone.
//
// Hip centres give heading and list; neck (else head) the trunk's tilt; a leg's hinge axis is the
// common normal of thigh, shank and foot, to which the knee counts by the sine of its flexion (a
// straight leg has no plane of its own) and the foot by a fixed weight. Exact for joints that
// forward_kinematics made from a body of these lengths; for measured joints the hip's rotation is
// the least certain of the angles.
#pragma once

#include <optional>

#include "body/pose.h"
#include "body/subject.h"

namespace walktrack {
inline namespace body {

// Only the ankle's neutral position takes `lengths`. nullopt if a hip, knee or ankle is unknown
// (NaN), or if two that a bone joins coincide. Without toes the foot is taken to point where the
// pelvis does; without neck and head the trunk is upright; arms whose joints are unknown stay at 0.
std::optional<Pose> pose_from_joints(const JointPositions& joints, const BodyLengths& lengths);

// The left-pointing hinge axis of a leg (unit, world); `left` is the pelvis's left, which stands in
// for an unknown foot.
Eigen::Vector3d leg_hinge_axis(const JointPositions& joints, Side side,
                               const Eigen::Vector3d& left);

}  // namespace body
}  // namespace walktrack
