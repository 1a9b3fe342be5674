// The inverse of forward kinematics: the angles of a pose from joint centres alone.
//
// Hip centres give heading and list; the neck (otherwise the head) gives the trunk's tilt. A leg's
// hinge axis is the common normal of thigh, shank and foot, in which the knee is weighted by the
// sine of its flexion (a straight leg has no plane of its own) and the foot by a fixed weight. The
// result is exact for joints from forward_kinematics with a body of these lengths; for measured
// joints the hip's rotation is the least certain angle.
#pragma once

#include <optional>

#include "body/pose.h"
#include "body/subject.h"

namespace walktrack {
inline namespace body {

// Only the ankle's neutral position depends on `lengths`. nullopt if a hip, knee or ankle is
// unknown (NaN), or if the two ends of a bone coincide. Without toes the foot is assumed to point
// in the direction of the pelvis; without neck and head the trunk is upright; arms with unknown
// joints stay at 0.
std::optional<Pose> pose_from_joints(const JointPositions& joints, const BodyLengths& lengths);

// The left-pointing hinge axis of a leg (unit, world). `left`: the pelvis's left, which is used if
// the foot is unknown.
Eigen::Vector3d leg_hinge_axis(const JointPositions& joints, Side side,
                               const Eigen::Vector3d& left);

}  // namespace body
}  // namespace walktrack
