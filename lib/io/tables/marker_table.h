// Trajectories of points from motion capture, as a file of another program states them.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace walktrack {
inline namespace io {

struct MarkerTable {
  std::string file;  // name in messages
  std::vector<std::string> names;
  std::vector<double> time;                          // s, increasing
  std::vector<std::vector<Eigen::Vector3d>> points;  // [row][name], m; NaN if unknown
};

}  // namespace io
}  // namespace walktrack
