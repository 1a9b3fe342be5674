#include "io/calibration/formats/opencv.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "io/archive/files.h"
#include "io/calibration/calibration_checks.h"
#include "io/calibration/yaml_matrix.h"
#include "io/config/yaml.h"

namespace walktrack {
inline namespace io {

namespace {

void read_distortion(Camera& camera, const YamlValue& root) {
  if (!root.has("distortion_coefficients")) return;
  const bool fisheye = root.has("fisheye") && root.at("fisheye").text() != "0" &&
                       root.at("fisheye").text() != "false";
  const YamlValue value = root.at("distortion_coefficients");
  const std::vector<double> coefficients =
      fisheye ? matrix_numbers(value, {4}) : matrix_numbers(value, {0, 4, 5, 8, 12, 14});
  set_distortion(camera, coefficients, fisheye);
}

std::string matrix_text(std::string_view key, int rows, int cols, std::span<const double> data) {
  std::string text = fmt::format(
      "{}: !!opencv-matrix\n   rows: {}\n   cols: {}\n   dt: d\n   data: [ ", key, rows, cols);
  for (size_t i = 0; i < data.size(); ++i) {
    // OpenCV distinguishes reals from integers by the decimal point.
    const std::string number = shortest_number(data[i]);
    const bool whole = number.find_first_of(".e") == std::string::npos;
    text += (i > 0 ? ", " : "") + number + (whole ? "." : "");
  }
  return text + " ]\n";
}

}  // namespace

Camera camera_from_opencv(const std::string& text, const std::string& file) {
  const YamlValue root = opencv_yaml(text, file);
  const Complain complain = [&](std::string_view key, std::string_view found,
                                std::string_view allowed) {
    root.at(std::string(key)).fail(found, allowed);
  };
  Camera camera;
  camera.width_px = root.at("image_width").integer(1, kMostPixels);
  camera.height_px = root.at("image_height").integer(1, kMostPixels);
  set_camera_matrix(camera, matrix3(matrix_numbers(root.at("camera_matrix"), {9})), complain);
  read_distortion(camera, root);
  const std::vector<double> rotation = matrix_numbers(root.at("rotation"), {3, 9});
  camera.rotation = rotation.size() == 3 ? rotation_from_rodrigues(Eigen::Vector3d(rotation.data()))
                                         : checked_rotation(matrix3(rotation), complain);
  camera.translation = Eigen::Vector3d(matrix_numbers(root.at("translation"), {3}).data());
  return camera;
}

std::string opencv_from_camera(const Camera& camera) {
  const std::array<double, 9> matrix{camera.focal_px.x(),
                                     0,
                                     camera.centre_px.x(),
                                     0,
                                     camera.focal_px.y(),
                                     camera.centre_px.y(),
                                     0,
                                     0,
                                     1};
  const Eigen::Matrix<double, 3, 3, Eigen::RowMajor> rotation = camera.rotation;
  const auto coefficients = distortion_coefficients(camera);
  const std::array<double, 5> none{};
  const std::span<const double> distortion =
      coefficients.empty() ? std::span<const double>(none) : coefficients;
  std::string text = fmt::format("%YAML:1.0\n---\nimage_width: {}\nimage_height: {}\n",
                                 camera.width_px, camera.height_px);
  text += matrix_text("camera_matrix", 3, 3, matrix);
  if (camera.lens == Lens::kFisheye) text += "fisheye: 1\n";
  text +=
      matrix_text("distortion_coefficients", 1, static_cast<int>(distortion.size()), distortion);
  text += matrix_text("rotation", 3, 3, {rotation.data(), 9});
  text += matrix_text("translation", 3, 1, {camera.translation.data(), 3});
  return text;
}

}  // namespace io
}  // namespace walktrack
