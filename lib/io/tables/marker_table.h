// Points of motion capture over time, as a file of another program has them.
#pragma once

#include <string>
#include <vector>

#include <Eigen/Core>

namespace walktrack {
inline namespace io {

struct MarkerTable {
  std::string file;  // what messages call it
  std::vector<std::string> names;
  std::vector<double> time;                          // s, increasing
  std::vector<std::vector<Eigen::Vector3d>> points;  // [row][name], m; NaN where it was not seen
};

}  // namespace io
}  // namespace walktrack
