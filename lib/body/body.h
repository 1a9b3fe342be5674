// The body of one subject: its lengths and the solid parts that are seen in images.
//
// A part is an elliptic truncated cone between two points of its axis, closed at either end by half
// an ellipsoid whose third semi-axis is the mean of that end's two. Semi-axes vary linearly along
// the axis. Only the groups that a scene asks for exist: a body without arms has no arm parts.
#pragma once

#include <cstddef>
#include <vector>

#include <Eigen/Core>

#include "body/pose.h"
#include "body/subject.h"

namespace walktrack {
inline namespace body {

// Classes of clothes and skin with equal appearance. The likelihood decides which classes it
// distinguishes.
enum class Appearance { kTrunk, kLegs, kFeet, kHead, kArms };
inline constexpr int kAppearanceCount = 5;

// The rigid segments that carry parts, each with an orientation in a Skeleton.
enum class Segment {
  kPelvis,
  kTrunk,
  kLeftThigh,
  kLeftShank,
  kLeftFoot,
  kRightThigh,
  kRightShank,
  kRightFoot,
  kLeftUpperArm,
  kLeftForearm,
  kRightUpperArm,
  kRightForearm,
};
inline constexpr int kSegmentCount = 12;

// Half widths of a cross-section along the segment's y (lateral) and x (forward) axes, metres.
struct CrossSection {
  double lateral, forward;
};

struct Part {
  Segment segment;
  Joint origin;  // the joint to which `lower` and `upper` are relative
  // Ends of the axis in the segment's axes, metres; from lower to upper is along +z for all parts
  // except the feet, for which it is along +x (lower = heel, upper = toes).
  Eigen::Vector3d lower, upper;
  CrossSection at_lower, at_upper;  // feet: `forward` is the half height of the foot
  Appearance appearance;
};

// An upper limit of the number of parts.
inline constexpr size_t kMaxParts = 24;

struct BodyGroups {
  bool head = true;
  bool arms = false;
};

struct Body {
  Subject subject;
  BodyGroups groups;
  BodyLengths lengths;
  std::vector<Part> parts;
};

Body make_body(const Subject& subject, const BodyGroups& groups);

}  // namespace body
}  // namespace walktrack
