// Matrices in YAML files, as OpenCV writes them.
#pragma once

#include <initializer_list>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "io/config/yaml.h"

namespace walktrack {
inline namespace io {

// The numbers of a matrix, row by row, from OpenCV's {rows, cols, dt, data}, a flat list or a list
// of rows. Throws an InputError for anything else or, for flat lists, for another count than
// allowed.
std::vector<double> matrix_numbers(const YamlValue& value);
std::vector<double> matrix_numbers(const YamlValue& value, std::initializer_list<size_t> counts);

Eigen::Matrix3d matrix3(const std::vector<double>& numbers);

// OpenCV writes "%YAML:1.0", which is not valid YAML. The line is blanked but kept, so that line
// numbers stay the same.
YamlValue opencv_yaml(std::string text, const std::string& file);

}  // namespace io
}  // namespace walktrack
