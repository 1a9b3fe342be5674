#include "io/figure/figure_mesh.h"

#include <algorithm>
#include <cmath>

#include "core/conventions.h"

namespace walktrack {
inline namespace io {

namespace {

using Eigen::Vector3d;

constexpr int kAround = 16;   // vertices in a ring
constexpr int kCapRings = 3;  // rings of a cap, in addition to the one at its border

size_t node_at(const AnimatedFigure& figure, Joint joint) {
  const auto at = std::find_if(figure.nodes.begin(), figure.nodes.end(),
                               [&](const FigureNode& node) { return node.joint == joint; });
  return static_cast<size_t>(at - figure.nodes.begin());
}

size_t node_of(const AnimatedFigure& figure, const Part& part) {
  if (part.appearance == Appearance::kHead) return node_at(figure, Joint::kNeck);
  // The trunk turns at the position of the pelvis, which is the previous part of the list.
  if (part.segment == Segment::kTrunk) return node_at(figure, Joint::kPelvis) + 1;
  return node_at(figure, part.origin);
}

MeshGroup group_of(Segment segment) {
  switch (segment) {
    case Segment::kPelvis:
    case Segment::kTrunk:
      return MeshGroup::kMiddle;
    case Segment::kLeftThigh:
    case Segment::kLeftShank:
    case Segment::kLeftFoot:
    case Segment::kLeftUpperArm:
    case Segment::kLeftForearm:
      return MeshGroup::kLeft;
    case Segment::kRightThigh:
    case Segment::kRightShank:
    case Segment::kRightFoot:
    case Segment::kRightUpperArm:
    case Segment::kRightForearm:
      break;
  }
  return MeshGroup::kRight;
}

// The axis of a part and the two directions of its cross-sections, right-handed in this order.
struct PartAxes {
  Vector3d first, second, along;
};

struct Ring {
  Vector3d centre;
  double first, second;  // half widths
};

// Adds the cap of one end (`out` = -1: the lower one): rings of half an ellipsoid from its border
// to near its tip.
void add_cap(const Vector3d& centre, const PartAxes& axes, const Ring& border, double out,
             std::vector<Ring>& rings) {
  const double depth = 0.5 * (border.first + border.second);
  for (int k = 0; k <= kCapRings; ++k) {
    const double latitude = 0.5 * kPi * k / (kCapRings + 1);
    rings.push_back({centre + out * depth * std::sin(latitude) * axes.along,
                     border.first * std::cos(latitude), border.second * std::cos(latitude)});
  }
}

void add_triangle(FigureMesh& mesh, std::vector<uint16_t>& triangles, size_t a, size_t b,
                  size_t c) {
  for (const size_t each : {a, b, c}) triangles.push_back(static_cast<uint16_t>(each));
  const Vector3d normal = (mesh.places[b] - mesh.places[a]).cross(mesh.places[c] - mesh.places[a]);
  for (const size_t each : {a, b, c}) mesh.normals[each] += normal;
}

// Adds a closed surface through the rings from the lower tip to the upper one.
void add_surface(const std::vector<Ring>& rings, const std::array<Vector3d, 2>& tips,
                 const PartAxes& axes, size_t node, std::vector<uint16_t>& triangles,
                 FigureMesh& mesh) {
  const size_t first = mesh.places.size(), around = kAround;
  for (const Ring& ring : rings) {
    for (int k = 0; k < kAround; ++k) {
      const double angle = 2 * kPi * k / kAround;
      mesh.places.push_back(ring.centre + ring.first * std::cos(angle) * axes.first +
                            ring.second * std::sin(angle) * axes.second);
    }
  }
  for (const Vector3d& tip : tips) mesh.places.push_back(tip);
  mesh.nodes.resize(mesh.places.size(), static_cast<uint8_t>(node));
  mesh.normals.resize(mesh.places.size(), Vector3d::Zero());
  const size_t lower = mesh.places.size() - 2, upper = lower + 1;
  const size_t last = first + (rings.size() - 1) * around;
  for (size_t k = 0; k < around; ++k) {
    const size_t next = (k + 1) % around;
    add_triangle(mesh, triangles, lower, first + next, first + k);
    add_triangle(mesh, triangles, upper, last + k, last + next);
    for (size_t at = first; at < last; at += around) {
      add_triangle(mesh, triangles, at + k, at + next, at + around + next);
      add_triangle(mesh, triangles, at + k, at + around + next, at + around + k);
    }
  }
}

void add_part(const Part& part, const Vector3d& origin, size_t node, FigureMesh& mesh) {
  const bool lies = part.appearance == Appearance::kFeet;
  const PartAxes axes = lies ? PartAxes{Vector3d::UnitY(), Vector3d::UnitZ(), Vector3d::UnitX()}
                             : PartAxes{Vector3d::UnitX(), Vector3d::UnitY(), Vector3d::UnitZ()};
  const auto border = [&](const CrossSection& section) {
    return lies ? Ring{{}, section.lateral, section.forward}
                : Ring{{}, section.forward, section.lateral};
  };
  const Vector3d lower = origin + part.lower, upper = origin + part.upper;
  const Ring below = border(part.at_lower), above = border(part.at_upper);
  std::vector<Ring> rings;
  add_cap(lower, axes, below, -1, rings);
  std::reverse(rings.begin(), rings.end());
  add_cap(upper, axes, above, 1, rings);
  const std::array<Vector3d, 2> tips{lower - 0.5 * (below.first + below.second) * axes.along,
                                     upper + 0.5 * (above.first + above.second) * axes.along};
  add_surface(rings, tips, axes, node, mesh.triangles[static_cast<size_t>(group_of(part.segment))],
              mesh);
}

}  // namespace

Body body_of_figure(const AnimatedFigure& figure, const Subject& subject) {
  const auto length = [&](Joint joint) {
    return figure.nodes[node_at(figure, joint)].offset.norm();
  };
  const bool arms = node_at(figure, Joint::kLeftWrist) < figure.nodes.size();
  Subject sized = subject;
  sized.lengths.thigh = 0.5 * (length(Joint::kLeftKnee) + length(Joint::kRightKnee));
  sized.lengths.shank = 0.5 * (length(Joint::kLeftAnkle) + length(Joint::kRightAnkle));
  if (arms) {
    sized.lengths.upper_arm = 0.5 * (length(Joint::kLeftElbow) + length(Joint::kRightElbow));
    sized.lengths.forearm = 0.5 * (length(Joint::kLeftWrist) + length(Joint::kRightWrist));
  }
  return make_body(sized, {.head = true, .arms = arms});
}

FigureMesh mesh_of(const AnimatedFigure& figure, const Body& body) {
  const std::vector<Vector3d> rest = rest_places(figure, body.lengths.ankle_height);
  FigureMesh mesh;
  for (const Part& part : body.parts)
    add_part(part, rest[node_at(figure, part.origin)], node_of(figure, part), mesh);
  for (Vector3d& normal : mesh.normals) normal.normalize();
  return mesh;
}

}  // namespace io
}  // namespace walktrack
