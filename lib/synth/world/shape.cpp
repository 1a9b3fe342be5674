#include "synth/world/shape.h"

#include <cmath>

namespace walktrack {
inline namespace synth {

namespace {

using Eigen::Vector3d;

// Extent of a bag, as shares of the trunk's length and of the stature; its ends are rounded.
constexpr double kPackFrom = 0.45, kPackTo = 0.85, kPackWide = 0.09;
constexpr double kHemFlare = 0.5;   // share of the hips' width, for a hem at the knees
constexpr double kHemSpace = 0.04;  // m around the legs

CrossSection wider(CrossSection section, double factor, double added) {
  return {factor * section.lateral + added, factor * section.forward + added};
}

void grow_head(Part& part, double factor) {
  const Vector3d middle = 0.5 * (part.lower + part.upper);
  for (Vector3d* end : {&part.lower, &part.upper}) *end = middle + factor * (*end - middle);
  for (CrossSection* section : {&part.at_lower, &part.at_upper})
    *section = wider(*section, factor, 0);
}

// Distance of trousers from the leg, which grows from the knee, the origin of a shank's parts, to
// the ankle.
double stands_off(const Part& part, const Vector3d& end, const Shape& shape, double shank) {
  const bool is_shank = part.segment == Segment::kLeftShank || part.segment == Segment::kRightShank;
  return is_shank ? shape.trousers * -end.z() / shank : 0;
}

void grow(Part& part, const Shape& shape, const BodyLengths& lengths) {
  if (part.appearance == Appearance::kFeet) return;
  if (part.appearance == Appearance::kHead) return grow_head(part, shape.head);
  const auto of = [&](const CrossSection& section, const Vector3d& end) {
    return wider(section, shape.girth, stands_off(part, end, shape, lengths.shank));
  };
  part.at_lower = of(part.at_lower, part.lower);
  part.at_upper = of(part.at_upper, part.upper);
}

// The surface of the back does not move.
void add_belly(Part& part, double belly, double waist) {
  if (part.segment != Segment::kTrunk || part.appearance != Appearance::kTrunk) return;
  const auto add = [&](Vector3d& end, CrossSection& section) {
    if (std::abs(end.z() - waist) > 1e-9) return;
    end.x() += 0.5 * belly;
    section.forward += 0.5 * belly;
  };
  add(part.lower, part.at_lower);
  add(part.upper, part.at_upper);
}

// It is fixed to the pelvis; legs swing within it and, at long steps, out of it.
Part skirt(const Part& pelvis, const Shape& shape, const BodyLengths& lengths) {
  Part out = pelvis;
  out.lower = {0, 0, -shape.skirt * lengths.thigh};
  out.at_lower = wider(pelvis.at_lower, 1 + kHemFlare * shape.skirt, kHemSpace);
  return out;
}

Part pack(const Body& body, double depth) {
  const double trunk = body.lengths.trunk, half = 0.5 * depth;
  const double back = -half - 0.065 * body.subject.height;
  const CrossSection section{kPackWide * body.subject.height, half};
  return {Segment::kTrunk,
          Joint::kPelvis,
          Vector3d(back, 0, kPackFrom * trunk),
          Vector3d(back, 0, kPackTo * trunk),
          section,
          section,
          Appearance::kFeet};
}

}  // namespace

Body shaped(Body body, const Shape& shape) {
  const double waist = body.parts.at(1).upper.z();  // the trunk's lowest part ends at the waist
  for (Part& part : body.parts) {
    grow(part, shape, body.lengths);
    add_belly(part, shape.belly, waist);
  }
  if (shape.skirt > 0) body.parts.push_back(skirt(body.parts.front(), shape, body.lengths));
  if (shape.pack > 0) body.parts.push_back(pack(body, shape.pack));
  return body;
}

}  // namespace synth
}  // namespace walktrack
