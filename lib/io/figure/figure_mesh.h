// The surface of a figure in its rest pose, as triangles of the body's solid parts (body/body.h).
// Every vertex moves with one joint.
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
  std::vector<uint8_t> nodes;                                    // the node with which a vertex
                                                                 // moves
  std::array<std::vector<uint16_t>, kMeshGroupCount> triangles;  // three each, counter-clockwise
};

// The subject's body with the segment lengths of the figure.
Body body_of_figure(const AnimatedFigure& figure, const Subject& subject);

FigureMesh mesh_of(const AnimatedFigure& figure, const Body& body);

}  // namespace io
}  // namespace walktrack
