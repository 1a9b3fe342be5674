// Points whose place in the room was measured and whose pixel was clicked: what puts a camera in
// its place.
//   u,v,x,y,z          px; metres, z up, ground z = 0; z may be left out for points on the ground
//   412.5,310,0,0,0
#pragma once

#include <filesystem>
#include <vector>

#include <Eigen/Core>

namespace walktrack {
inline namespace io {

struct MeasuredPoints {
  std::vector<Eigen::Vector2d> pixels;
  std::vector<Eigen::Vector3d> world;
  std::vector<int> lines;  // of the file, for messages
};

// InputError naming line and column; fewer than four points, or all on one line in the room, too.
MeasuredPoints read_measured_points(const std::filesystem::path& path);

}  // namespace io
}  // namespace walktrack
