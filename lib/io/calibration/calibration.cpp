#include "io/calibration/calibration.h"

#include <algorithm>
#include <cctype>

#include "core/errors.h"
#include "io/archive/files.h"

namespace walktrack {

namespace {

constexpr size_t kMostBytes = 16u << 20;

std::string lower_case_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

}  // namespace

Camera read_calibration(const std::filesystem::path& path, const std::string& name) {
  const std::string extension = lower_case_extension(path);
  const std::string file = path.string();
  if (extension == ".yaml" || extension == ".yml" || extension == ".json") {
    return camera_from_opencv(read_text_file(path, kMostBytes), file);
  }
  if (extension == ".toml") return camera_from_toml(read_text_file(path, kMostBytes), file, name);
  if (extension == ".xml") return camera_from_tsai(read_text_file(path, kMostBytes), file);
  throw InputError(describe({file, 0, ""}, "'" + extension + "' as calibration",
                            ".yaml .yml .json (OpenCV), .toml (Pose2Sim, Anipose), .xml (Tsai)"));
}

}  // namespace walktrack
