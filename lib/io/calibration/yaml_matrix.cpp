#include "io/calibration/yaml_matrix.h"

#include <algorithm>

#include <fmt/format.h>

namespace walktrack {
inline namespace io {

std::vector<double> matrix_numbers(const YamlValue& value) {
  if (value.is_map()) return matrix_numbers(value.at("data"));
  if (!value.is_list()) value.fail(value.describe_found(), "a matrix");
  std::vector<double> numbers;
  for (const YamlValue& item : value.items()) {
    if (item.is_list()) {
      const std::vector<double> row = item.numbers();
      numbers.insert(numbers.end(), row.begin(), row.end());
    } else {
      numbers.push_back(item.number());
    }
  }
  return numbers;
}

std::vector<double> matrix_numbers(const YamlValue& value, std::initializer_list<size_t> counts) {
  std::vector<double> numbers = matrix_numbers(value);
  if (std::find(counts.begin(), counts.end(), numbers.size()) == counts.end()) {
    value.fail(fmt::format("{} numbers", numbers.size()),
               fmt::format("{} numbers", fmt::join(counts, " or ")));
  }
  return numbers;
}

Eigen::Matrix3d matrix3(const std::vector<double>& numbers) {
  return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(numbers.data());
}

YamlValue opencv_yaml(std::string text, const std::string& file) {
  if (text.starts_with("%YAML:")) text[0] = '#';
  return YamlValue::from_text(text, file);
}

}  // namespace io
}  // namespace walktrack
