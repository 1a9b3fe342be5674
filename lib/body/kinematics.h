// Forward kinematics: pose -> joint centres, segment orientations and posed parts.
//
// Standing on a foot: the sole is flat from heel strike to heel-off, then rotates about the ball,
// which does not move (the model of three rockers without the first, Perry 1992). The root follows
// from the ball's position on the ground and the leg's angles.
#pragma once

#include <array>

#include <Eigen/Core>

#include "body/body.h"
#include "body/pose.h"

namespace walktrack {
inline namespace body {

struct Skeleton {
  JointPositions joints;                                          // world
  std::array<Eigen::Matrix3d, kSegmentCount> world_from_segment;  // undefined for parts that the
                                                                  // body lacks
  const Eigen::Matrix3d& axes(Segment s) const {
    return world_from_segment[static_cast<size_t>(s)];
  }
};

// A part in the world. `lower`, `upper`: ends of its axis; `lateral`, `forward`: unit vectors of
// its cross-section, orthogonal to each other and to the segment's long axis.
struct PosedPart {
  Eigen::Vector3d lower, upper;
  Eigen::Vector3d lateral, forward;
  CrossSection at_lower, at_upper;
  Appearance appearance;
};

Eigen::Matrix3d world_from_pelvis(const Pose& pose);

Skeleton forward_kinematics(const Body& body, const Pose& pose);

// A list of at most kMaxParts. It is stored on the stack: a particle's likelihood allocates
// nothing.
class PosedParts {
 public:
  size_t size() const { return size_; }
  const PosedPart* data() const { return items_.data(); }
  const PosedPart& operator[](size_t i) const { return items_[i]; }
  const PosedPart* begin() const { return items_.data(); }
  const PosedPart* end() const { return items_.data() + size_; }

  // Throws std::length_error beyond kMaxParts.
  void push_back(const PosedPart& part);

 private:
  std::array<PosedPart, kMaxParts> items_;
  size_t size_ = 0;
};

// The parts of a skeleton, one for each of body.parts in the same order.
PosedParts pose_parts(const Body& body, const Skeleton& skeleton);

// The vector from hip to ankle of one leg in the world, for the root's orientation and the leg
// angles of `pose`; the root's position has no effect.
Eigen::Vector3d ankle_from_root(const Body& body, const Pose& pose, Side side);

// Position of the ankle relative to the ball for a sole with the pitch `pitch` (0 flat, positive =
// heel up): (forward, up), metres.
Eigen::Vector2d ankle_from_ball(const BodyLengths& lengths, double pitch);

// The pitch at which the ball is on the line from the ankle to the ball's position on the ground:
// the inverse function if the distance is the foot's.
double sole_pitch(const BodyLengths& lengths, const Eigen::Vector2d& ankle_from_ball);

// Sets the root and the ankle's dorsiflexion so that the ankle of `side` is at `ankle_from_ball`
// along the foot (forward, up) from the foot's position, which is the ground below its ball, and
// the ball is there.
void stand_on(const Body& body, Side side, const Eigen::Vector3d& ball,
              const Eigen::Vector2d& ankle_from_ball, Pose& pose);

}  // namespace body
}  // namespace walktrack
