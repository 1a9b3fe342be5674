#include "io/calibration/formats/vicon.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <sstream>
#include <vector>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "core/conventions.h"
#include "core/errors.h"
#include "io/archive/files.h"
#include "io/calibration/inverse_lens.h"
#include "io/calibration/xml_element.h"

namespace walktrack {
inline namespace io {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr const char* kVicon = "a Vicon calibration with cameras";
constexpr size_t kMostViconCameras = 256;
constexpr double kUnitTolerance = 1e-3;  // of a quaternion with rounded digits

struct ViconCamera {
  XmlElement camera;
  size_t from, to;  // offsets in the text
};

std::vector<ViconCamera> vicon_cameras(const std::string& text, const std::string& file) {
  std::vector<ViconCamera> out;
  for (size_t at = text.find("<Camera "); at != std::string::npos;
       at = text.find("<Camera ", at + 1)) {
    if (!out.empty()) out.back().to = at;
    if (out.size() == kMostViconCameras)
      throw InputError(describe({file, 0, ""},
                                fmt::format("more than {} cameras", kMostViconCameras),
                                "those of one laboratory"));
    out.push_back({XmlElement(text, file, "Camera", kVicon, at), at, text.size()});
  }
  if (out.empty()) throw InputError(describe({file, 0, ""}, "no <Camera> element", kVicon));
  return out;
}

bool is_calibrated(const std::string& text, const ViconCamera& camera) {
  return text.find("<KeyFrame ", camera.from) < camera.to;
}

bool films(const XmlElement& camera) {
  for (const char* key : {"TYPE", "DISPLAY_TYPE"}) {
    if (!camera.has(key)) continue;
    std::string type = camera.text(key);
    std::transform(type.begin(), type.end(), type.begin(),
                   [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    if (type.find("video") != std::string::npos || type.starts_with("vue")) return true;
  }
  return camera.has("ISDV") && camera.text("ISDV") != "0";
}

std::vector<double> numbers(const XmlElement& element, const char* key, size_t count,
                            const std::string& text) {
  std::istringstream stream(text);
  std::vector<double> out;
  for (std::string word; out.size() <= count && stream >> word;)
    if (const auto value = number_from_text(word))
      out.push_back(*value);
    else
      element.fail(key, fmt::format("'{}'", word), "a number");
  if (out.size() != count)
    element.fail(key, fmt::format("'{}'", text), fmt::format("{} numbers", count));
  return out;
}

std::vector<double> numbers(const XmlElement& element, const char* key, size_t count) {
  return numbers(element, key, count, element.text(key));
}

// The only key frame, or the first of several with the same pose. A camera that moves is not
// supported.
XmlElement key_frame(const std::string& text, const std::string& file, const ViconCamera& camera,
                     const std::string& name) {
  XmlElement first(text, file, "KeyFrame",
                   fmt::format("camera '{}' calibrated, with a <KeyFrame>", name), camera.from,
                   camera.to);
  for (size_t at = text.find("<KeyFrame ", first.start() + 1); at < camera.to;
       at = text.find("<KeyFrame ", at + 1)) {
    const XmlElement other(text, file, "KeyFrame", kVicon, at, camera.to);
    for (const char* key : {"POSITION", "ORIENTATION"})
      if (other.text(key) != first.text(key))
        other.fail(key, "another place than in the first key frame", "a camera that stands still");
  }
  return first;
}

int sensor_side(const XmlElement& camera, double pixels) {
  if (!(pixels >= 1 && pixels <= kMostPixels) || pixels != static_cast<int>(pixels))
    camera.fail("SENSOR_SIZE", fmt::format("{:g}", pixels), "whole numbers of pixels");
  return static_cast<int>(pixels);
}

struct Radial {
  Vector2d centre;  // px
  std::array<double, 3> k;
  const char* key;
};

Radial radial_of(const XmlElement& key, const Vector2d& principal) {
  if (key.has("VICON_RADIAL2")) {
    const char* name = "VICON_RADIAL2";
    const std::string text = key.text(name), model = "Vicon3Parameter";
    if (!text.starts_with(model + " "))
      key.fail(name, fmt::format("'{}'", text), model + " and five numbers");
    const auto n = numbers(key, name, 5, text.substr(model.size()));
    return {{n[0], n[1]}, {n[2], n[3], n[4]}, name};
  }
  if (!key.has("VICON_RADIAL")) return {principal, {0, 0, 0}, "VICON_RADIAL"};
  const auto n = numbers(key, "VICON_RADIAL", 2);
  return {principal, {n[0], n[1], 0}, "VICON_RADIAL"};
}

void set_lens(const XmlElement& key, Camera& camera) {
  const Radial radial = radial_of(key, camera.centre_px);
  if (radial.k == std::array<double, 3>{0, 0, 0}) return;
  const auto straight = [&](const Vector2d& pixel) -> Vector2d {
    const Vector2d away = pixel - radial.centre;
    const double d2 = away.squaredNorm();
    return radial.centre + (1 + d2 * (radial.k[0] + d2 * (radial.k[1] + d2 * radial.k[2]))) * away;
  };
  set_inverse_distortion(
      camera, straight, radial.key,
      [&](std::string_view name, std::string_view found, std::string_view allowed) {
        key.fail(std::string(name), found, allowed);
      });
}

void set_place(const XmlElement& key, Camera& camera) {
  const auto q = numbers(key, "ORIENTATION", 4), at = numbers(key, "POSITION", 3);
  const Eigen::Quaterniond turn(q[3], q[0], q[1], q[2]);
  if (!(std::abs(turn.norm() - 1) <= kUnitTolerance))
    key.fail("ORIENTATION", fmt::format("a quaternion of length {:g}", turn.norm()),
             "x y z w of length 1");
  camera.rotation = turn.normalized().toRotationMatrix();
  camera.translation = -kMetresPerMillimetre * (camera.rotation * Vector3d(at[0], at[1], at[2]));
}

}  // namespace

std::vector<std::string> vicon_names(const std::string& text, const std::string& file) {
  std::vector<std::string> all, filming;
  for (const ViconCamera& each : vicon_cameras(text, file)) {
    if (!is_calibrated(text, each)) continue;
    all.push_back(each.camera.text("DEVICEID"));
    if (films(each.camera)) filming.push_back(all.back());
  }
  if (all.empty())
    throw InputError(describe({file, 0, ""}, "no camera with a <KeyFrame>", "calibrated cameras"));
  return filming.empty() ? all : filming;
}

Camera camera_from_vicon(const std::string& text, const std::string& file,
                         const std::string& name) {
  const std::vector<ViconCamera> cameras = vicon_cameras(text, file);
  const auto found = std::find_if(cameras.begin(), cameras.end(), [&](const ViconCamera& each) {
    return each.camera.has("DEVICEID") && each.camera.text("DEVICEID") == name;
  });
  if (found == cameras.end())
    throw InputError(describe({file, 0, ""}, fmt::format("no camera '{}'", name),
                              fmt::format("{}", fmt::join(vicon_names(text, file), ", "))));
  const XmlElement key = key_frame(text, file, *found, name);
  Camera camera;
  const auto size = numbers(found->camera, "SENSOR_SIZE", 2);
  camera.width_px = sensor_side(found->camera, size[0]);
  camera.height_px = sensor_side(found->camera, size[1]);
  if (found->camera.has("SKEW") && found->camera.number("SKEW") != 0)
    found->camera.fail("SKEW", found->camera.text("SKEW"), "cameras without skew");
  const double focal = key.positive("FOCAL_LENGTH");
  const double aspect =
      found->camera.has("PIXEL_ASPECT_RATIO") ? found->camera.positive("PIXEL_ASPECT_RATIO") : 1;
  camera.focal_px = {focal, focal / aspect};
  const auto principal = numbers(key, "PRINCIPAL_POINT", 2);
  camera.centre_px = {principal[0], principal[1]};
  set_lens(key, camera);
  set_place(key, camera);
  return camera;
}

}  // namespace io
}  // namespace walktrack
