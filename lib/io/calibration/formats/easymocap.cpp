#include "io/calibration/formats/easymocap.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/calibration/yaml_matrix.h"

namespace walktrack {
inline namespace io {

namespace {

std::vector<std::string> names_in(const YamlValue& intrinsics) {
  std::vector<std::string> out;
  for (const YamlValue& name : intrinsics.at("names").items()) out.push_back(name.text());
  return out;
}

int pixels(const YamlValue& value) {
  const double number = value.number(1, kMostPixels);
  if (number != std::floor(number)) value.fail(fmt::format("{:g}", number), "whole pixels");
  return static_cast<int>(number);
}

void set_size(Camera& camera, const YamlValue& intrinsics, const std::string& name,
              const std::optional<ImageSize>& size) {
  const std::string width = "W_" + name, height = "H_" + name;
  if (intrinsics.has(width) && intrinsics.has(height)) {
    camera.width_px = pixels(intrinsics.at(width));
    camera.height_px = pixels(intrinsics.at(height));
  } else if (size) {
    camera.width_px = size->width_px;
    camera.height_px = size->height_px;
  } else {
    throw InputError(
        describe({intrinsics.file(), 0, width}, "no image size",
                 fmt::format("{} and {}, pixels, in the file, or walktrack calibrate --import FILE "
                             "--image-size WxH",
                             width, height)));
  }
}

}  // namespace

bool is_easymocap(const std::string& text, const std::string& file) {
  const YamlValue root = opencv_yaml(text, file);
  if (!root.is_map() || !root.has("names")) return false;
  const std::vector<std::string> keys = root.keys();
  return std::any_of(keys.begin(), keys.end(),
                     [](const std::string& key) { return key.starts_with("K_"); });
}

std::vector<std::string> easymocap_names(const std::string& text, const std::string& file) {
  return names_in(opencv_yaml(text, file));
}

Camera camera_from_easymocap(const FileText& intrinsic, const FileText& extrinsic,
                             const std::string& name, const std::optional<ImageSize>& size) {
  const YamlValue intrinsics = opencv_yaml(intrinsic.text, intrinsic.file),
                  extrinsics = opencv_yaml(extrinsic.text, extrinsic.file);
  const std::vector<std::string> names = names_in(intrinsics);
  if (std::find(names.begin(), names.end(), name) == names.end())
    throw InputError(describe({intrinsic.file, 0, ""}, fmt::format("no camera '{}'", name),
                              fmt::format("{}", fmt::join(names, ", "))));
  const YamlValue matrix = intrinsics.at("K_" + name), bent = intrinsics.at("dist_" + name);
  const Complain complain = [&](std::string_view, std::string_view found,
                                std::string_view allowed) { matrix.fail(found, allowed); };
  Camera camera;
  set_size(camera, intrinsics, name, size);
  set_camera_matrix(camera, matrix3(matrix_numbers(matrix, {9})), complain);
  set_distortion(camera, matrix_numbers(bent, {4, 5, 8, 12, 14}));
  // EasyMocap itself uses the rotation vector if both are present.
  if (extrinsics.has("R_" + name)) {
    camera.rotation = rotation_from_rodrigues(
        Eigen::Vector3d(matrix_numbers(extrinsics.at("R_" + name), {3}).data()));
  } else {
    const YamlValue rotation = extrinsics.at("Rot_" + name);
    camera.rotation =
        checked_rotation(matrix3(matrix_numbers(rotation, {9})),
                         [&](std::string_view, std::string_view found, std::string_view allowed) {
                           rotation.fail(found, allowed);
                         });
  }
  camera.translation = Eigen::Vector3d(matrix_numbers(extrinsics.at("T_" + name), {3}).data());
  return camera;
}

}  // namespace io
}  // namespace walktrack
