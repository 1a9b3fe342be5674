// Points whose position in the room was measured and whose pixel was marked by hand, from which the
// pose of a camera is estimated.
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
  std::vector<int> lines;  // line numbers in the file, for messages
};

// Throws an InputError that names line and column; also for fewer than four points, and for points
// that all lie on one line in the room.
MeasuredPoints read_measured_points(const std::filesystem::path& path);

}  // namespace io
}  // namespace walktrack
