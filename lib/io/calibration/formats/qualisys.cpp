#include "io/calibration/formats/qualisys.h"

#include <vector>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "core/conventions.h"
#include "core/errors.h"
#include "io/calibration/calibration_checks.h"
#include "io/calibration/xml_element.h"

namespace walktrack {
inline namespace io {

namespace {

constexpr const char* kQualisys = "a Qualisys calibration with cameras";
constexpr double kPerPixel = 64;
constexpr size_t kMostCameras = 256;

struct CameraEntry {
  std::string name;
  size_t from, to;  // offsets in the text
};

std::vector<CameraEntry> entries_of(const std::string& text, const std::string& file) {
  std::vector<CameraEntry> out;
  for (size_t at = text.find("<camera "); at != std::string::npos;
       at = text.find("<camera ", at + 1)) {
    if (!out.empty()) out.back().to = at;
    if (out.size() == kMostCameras)
      throw InputError(describe({file, 0, ""}, fmt::format("more than {} cameras", kMostCameras),
                                "those of one laboratory"));
    const XmlElement camera(text, file, "camera", kQualisys, at);
    out.push_back({camera.text("serial"), at, text.size()});
  }
  if (out.empty()) throw InputError(describe({file, 0, ""}, "no <camera> element", kQualisys));
  return out;
}

const CameraEntry& entry_called(const std::vector<CameraEntry>& entries, const std::string& file,
                                const std::string& name) {
  std::vector<std::string> names;
  for (const CameraEntry& entry : entries) {
    if (entry.name == name) return entry;
    names.push_back(entry.name);
  }
  throw InputError(describe({file, 0, ""}, fmt::format("no camera '{}'", name),
                            fmt::format("{}", fmt::join(names, ", "))));
}

int side(const XmlElement& view, const char* low, const char* high) {
  const double pixels = view.number(high) - view.number(low) + 1;
  if (!(pixels >= 1 && pixels <= kMostPixels) || pixels != static_cast<int>(pixels))
    view.fail(high, fmt::format("{:g} pixels", pixels), "whole numbers of pixels");
  return static_cast<int>(pixels);
}

Eigen::Matrix3d rotation_of(const XmlElement& transform) {
  Eigen::Matrix3d out;
  for (Eigen::Index row = 0; row < 3; ++row)
    for (Eigen::Index column = 0; column < 3; ++column)
      out(row, column) = transform.number(fmt::format("r{}{}", row + 1, column + 1));
  const Complain complain = [&](std::string_view, std::string_view found,
                                std::string_view allowed) {
    transform.fail("r11", found, allowed);
  };
  const Eigen::Matrix3d up = checked_rotation(out, complain);
  return Eigen::Vector3d(1, -1, -1).asDiagonal() * up;  // axes x right, y down, z forward
}

}  // namespace

std::vector<std::string> qualisys_names(const std::string& text, const std::string& file) {
  std::vector<std::string> out;
  for (const CameraEntry& entry : entries_of(text, file)) out.push_back(entry.name);
  return out;
}

Camera camera_from_qualisys(const std::string& text, const std::string& file,
                            const std::string& name) {
  const std::vector<CameraEntry> entries = entries_of(text, file);
  const CameraEntry& entry = entry_called(entries, file, name);
  const auto element = [&](const char* what) {
    return XmlElement(text, file, what, fmt::format("one for camera '{}'", name), entry.from,
                      entry.to);
  };
  const XmlElement view = element("fov_video"), intrinsic = element("intrinsic"),
                   transform = element("transform");
  Camera camera;
  camera.width_px = side(view, "left", "right");
  camera.height_px = side(view, "top", "bottom");
  camera.focal_px = {intrinsic.positive("focalLengthU") / kPerPixel,
                     intrinsic.positive("focalLengthV") / kPerPixel};
  camera.centre_px = {intrinsic.number("centerPointU") / kPerPixel - view.number("left"),
                      intrinsic.number("centerPointV") / kPerPixel - view.number("top")};
  const auto bent = [&](const char* key) { return intrinsic.number(key) / kPerPixel; };
  set_distortion(camera,
                 std::vector<double>{bent("radialDistortion1"), bent("radialDistortion2"),
                                     bent("tangentalDistortion1"), bent("tangentalDistortion2"),
                                     bent("radialDistortion3")});
  camera.rotation = rotation_of(transform);
  const Eigen::Vector3d centre(transform.number("x"), transform.number("y"), transform.number("z"));
  camera.translation = -kMetresPerMillimetre * (camera.rotation * centre);
  return camera;
}

}  // namespace io
}  // namespace walktrack
