// Forward kinematics: pose -> joint centres, segment orientations and posed parts.
//
// Standing on a foot: the sole lies flat from strike to heel-off, then turns about the ball, which
// never moves (model of the three rockers without the first, Perry 1992). The root follows from the
// ball's place on the ground and the leg's angles.
#pragma once

#include <array>

#include <Eigen/Core>

#include "body/body.h"
#include "body/pose.h"

namespace walktrack {
inline namespace body {

struct Skeleton {
  JointPositions joints;                                          // world
  std::array<Eigen::Matrix3d, kSegmentCount> world_from_segment;  // unset for groups left out
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

// A list of at most kMaxParts. Lives on the stack: a particle's likelihood allocates nothing.
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

// The parts of a skeleton, one for each of body.parts and in their order.
PosedParts pose_parts(const Body& body, const Skeleton& skeleton);

// The hip-to-ankle vector of one leg in the world for root orientation and leg angles of `pose`;
// the root's position does not matter.
Eigen::Vector3d ankle_from_root(const Body& body, const Pose& pose, Side side);

// Ankle relative to the ball for a sole pitched by `pitch` (0 flat, positive = heel up) about its
// ball: (forward, up), metres.
Eigen::Vector2d ankle_from_ball(const BodyLengths& lengths, double pitch);

// The pitch at which the ball lies straight between the ankle and the ball's place on the ground:
// its inverse where the distance is the foot's.
double sole_pitch(const BodyLengths& lengths, const Eigen::Vector2d& ankle_from_ball);

// Puts the pose's `side` ankle over the foot's place, the ground below its ball, at
// `ankle_from_ball` along the foot (forward, up), and turns the foot to have its ball there: sets
// the root and that ankle's dorsiflexion.
void stand_on(const Body& body, Side side, const Eigen::Vector3d& ball,
              const Eigen::Vector2d& ankle_from_ball, Pose& pose);

}  // namespace body
}  // namespace walktrack
