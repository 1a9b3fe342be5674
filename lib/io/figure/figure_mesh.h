// The surface of a figure in its rest pose, every vertex on one joint: the body's solid parts
// (body/body.h) as triangles.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "body/body.h"
#include "io/figure/animated_figure.h"

namespace walktrack {
inline namespace io {

enum class MeshGroup { kMiddle, kLeft, kRight };
inline constexpr size_t kMeshGroupCount = 3;

struct FigureMesh {
  std::vector<Eigen::Vector3d> places;                           // world of the rest pose, m
  std::vector<Eigen::Vector3d> normals;                          // outwards, unit
  std::vector<uint8_t> nodes;                                    // that a vertex moves with
  std::array<std::vector<uint16_t>, kMeshGroupCount> triangles;  // three each, counter-clockwise
};

// The body of the subject with the lengths of the figure.
Body body_of_figure(const AnimatedFigure& figure, const Subject& subject);

FigureMesh mesh_of(const AnimatedFigure& figure, const Body& body);

}  // namespace io
}  // namespace walktrack
