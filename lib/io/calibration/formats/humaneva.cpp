#include "io/calibration/formats/humaneva.h"

#include <sstream>
#include <vector>

#include <fmt/format.h>

#include "core/conventions.h"
#include "core/errors.h"
#include "io/archive/files.h"

namespace walktrack {
inline namespace io {

namespace {

constexpr size_t kNumbers = 22;

struct LineNumbers {
  std::vector<double> value;
  std::vector<int> line;
};

LineNumbers read_numbers(const std::string& text, const std::string& file) {
  std::istringstream lines(text);
  LineNumbers out;
  int line = 0;
  for (std::string content; std::getline(lines, content);) {
    ++line;
    std::istringstream words(content);
    for (std::string word; words >> word;) {
      const auto value = number_from_text(word);
      if (!value)
        throw InputError(describe({file, line, ""}, fmt::format("'{}'", word), "a number"));
      out.value.push_back(*value);
      out.line.push_back(line);
    }
  }
  if (out.value.size() != kNumbers)
    throw InputError(describe({file, line, ""}, fmt::format("{} numbers", out.value.size()),
                              fmt::format("the {} of a HumanEva calibration", kNumbers)));
  return out;
}

}  // namespace

Camera camera_from_humaneva(const std::string& text, const std::string& file,
                            const std::optional<ImageSize>& size) {
  const LineNumbers n = read_numbers(text, file);
  if (!size)
    throw InputError(describe({file, 0, ""}, "no image size",
                              "walktrack calibrate --import FILE --image-size WxH; of HumanEva-I "
                              "640x480 for C1 to C3, 644x488 for BW1 to BW4"));
  const auto complain = [&](size_t number) {
    return [&, number](std::string_view key, std::string_view found, std::string_view allowed) {
      throw InputError(describe({file, n.line[number], std::string(key)}, found, allowed));
    };
  };
  Camera camera;
  camera.width_px = size->width_px;
  camera.height_px = size->height_px;
  Eigen::Matrix3d matrix;
  matrix << n.value[0], n.value[4], n.value[2], 0, n.value[1], n.value[3], 0, 0, 1;
  set_camera_matrix(camera, matrix, complain(0));
  set_distortion(camera, std::span(n.value).subspan(5, 5));
  camera.rotation = checked_rotation(
      Eigen::Matrix<double, 3, 3, Eigen::RowMajor>(n.value.data() + 10), complain(10));
  camera.translation = kMetresPerMillimetre * Eigen::Vector3d(n.value.data() + 19);
  return camera;
}

}  // namespace io
}  // namespace walktrack
