#include "io/calibration/formats/opencap.h"

#include <cmath>

#include <fmt/format.h>

#include "core/conventions.h"
#include "core/errors.h"
#include "io/calibration/calibration_checks.h"
#include "io/calibration/pickle.h"

namespace walktrack {
inline namespace io {

namespace {

class Session {
 public:
  Session(const std::string& bytes, std::string file)
      : arrays_(read_pickled_arrays(bytes, file)), file_(std::move(file)) {}

  [[noreturn]] void fail(const std::string& key, std::string_view found,
                         std::string_view allowed) const {
    throw InputError(describe({file_, 0, key}, found, allowed));
  }

  const std::vector<double>& numbers(const std::string& key, size_t least, size_t most) const {
    const auto found = arrays_.find(key);
    if (found == arrays_.end()) fail(key, "nothing", "an array, as in OpenCap's files");
    const std::vector<double>& out = found->second.numbers;
    if (out.size() < least || out.size() > most)
      fail(key, fmt::format("{} numbers", out.size()),
           least == most ? fmt::format("{}", least) : fmt::format("{} to {}", least, most));
    for (const double each : out)
      if (!std::isfinite(each)) fail(key, "an entry that is no number", "numbers");
    return out;
  }

  Eigen::Matrix3d matrix(const std::string& key) const {
    return Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(
        numbers(key, 9, 9).data());
  }

  int pixels(const std::string& key, size_t at) const {
    const double value = numbers(key, 2, 2)[at];
    if (value != std::floor(value) || value < 1 || value > kMostPixels)
      fail(key, fmt::format("{:g}", value), "whole numbers of pixels, height and width");
    return static_cast<int>(value);
  }

 private:
  std::map<std::string, PickledArray> arrays_;
  std::string file_;
};

}  // namespace

Camera camera_from_opencap(const std::string& bytes, const std::string& file) {
  const Session session(bytes, file);
  const auto complain_of = [&](const std::string& key) -> Complain {
    return [&session, key](std::string_view, std::string_view found, std::string_view allowed) {
      session.fail(key, found, allowed);
    };
  };
  Camera camera;
  camera.height_px = session.pixels("imageSize", 0);
  camera.width_px = session.pixels("imageSize", 1);
  set_camera_matrix(camera, session.matrix("intrinsicMat"), complain_of("intrinsicMat"));
  const std::vector<double>& bent = session.numbers("distortion", 4, 14);
  try {
    set_distortion(camera, bent);
  } catch (const InputError&) {
    session.fail("distortion", fmt::format("{} numbers", bent.size()), "4, 5, 8, 12 or 14");
  }
  camera.rotation = checked_rotation(session.matrix("rotation"), complain_of("rotation"));
  camera.translation =
      kMetresPerMillimetre * Eigen::Vector3d(session.numbers("translation", 3, 3).data());
  return camera;
}

}  // namespace io
}  // namespace walktrack
