// Calibration files of cameras, in the file's own axes (metres, x_camera = R x + t).
//
// OpenCV (.yaml .yml .json): image_width image_height camera_matrix distortion_coefficients
//   rotation (3x3 or Rodrigues vector) translation, and optionally fisheye; matrices as OpenCV
//   writes them or as plain lists; other keys are ignored.
//
// Pose2Sim or Anipose (.toml): a table for each camera with name, size, matrix, distortions,
//   rotation (Rodrigues), translation, fisheye; the camera is found by its name or its table's.
//   Lengths are taken as metres, as Pose2Sim has them.
// Tsai (.xml): <Camera> with Geometry, Intrinsic and Extrinsic, millimetres, as of the PETS data
//   (Tsai, IEEE J. Robotics and Automation 3(4), 1987). Its distortion is turned into OpenCV's by a
//   fit over the image.
//
// Qualisys (.qca.txt), Vicon (.xcp), EasyMocap (intri.yml with extri.yml beside it), OpenCap
// (.pickle of one camera) and HumanEva (.cal) are described where they are read,
// calibration_<tool>.cpp.
//
// All readers throw InputError naming file, line where the format has lines, key, what was found
// and what is allowed. A rotation may be rounded (kRotationTolerance) and is made exact.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "camera/camera.h"

namespace walktrack {
inline namespace io {

struct ImageSize {
  int width_px, height_px;
};

// Reads the camera called `name`, which selects one in files with several cameras. `size`: of the
// images, for files that do not state it.
Camera read_calibration(const std::filesystem::path& path, const std::string& name,
                        const std::optional<ImageSize>& size = std::nullopt);

// The cameras of a file with several, in its order; empty for a file with one camera.
std::vector<std::string> calibration_names(const std::filesystem::path& path);

// One function for each format; `file` is its name in messages.
Camera camera_from_opencv(const std::string& text, const std::string& file);

Camera camera_from_toml(const std::string& text, const std::string& file, const std::string& name);
std::vector<std::string> toml_names(const std::string& text, const std::string& file);
Camera camera_from_tsai(const std::string& text, const std::string& file);
Camera camera_from_qualisys(const std::string& text, const std::string& file,
                            const std::string& name);
std::vector<std::string> qualisys_names(const std::string& text, const std::string& file);
Camera camera_from_vicon(const std::string& text, const std::string& file, const std::string& name);
std::vector<std::string> vicon_names(const std::string& text, const std::string& file);
Camera camera_from_humaneva(const std::string& text, const std::string& file,
                            const std::optional<ImageSize>& size = std::nullopt);
Camera camera_from_opencap(const std::string& bytes, const std::string& file);

struct FileText {
  std::string text, file;
};
// Whether a YAML file is EasyMocap's intri.yml.
bool is_easymocap(const std::string& text, const std::string& file);
Camera camera_from_easymocap(const FileText& intrinsic, const FileText& extrinsic,
                             const std::string& name,
                             const std::optional<ImageSize>& size = std::nullopt);
std::vector<std::string> easymocap_names(const std::string& text, const std::string& file);

// The OpenCV file of a camera; reading it back gives the same camera, bit for bit.
std::string opencv_from_camera(const Camera& camera);

// A Pose2Sim file of cameras. Reading it back gives the same cameras up to the rounding of the
// rotation vector.
std::string toml_from_cameras(const std::vector<std::pair<std::string, Camera>>& cameras);

// Allowed deviation of R'R from the identity (largest entry), for rounded digits.
inline constexpr double kRotationTolerance = 1e-3;

}  // namespace io
}  // namespace walktrack
