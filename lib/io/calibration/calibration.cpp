#include "io/calibration/calibration.h"

#include <algorithm>
#include <cctype>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/calibration/formats/easymocap.h"
#include "io/calibration/formats/humaneva.h"
#include "io/calibration/formats/opencap.h"
#include "io/calibration/formats/opencv.h"
#include "io/calibration/formats/qualisys.h"
#include "io/calibration/formats/toml.h"
#include "io/calibration/formats/tsai.h"
#include "io/calibration/formats/vicon.h"

namespace walktrack {
inline namespace io {

namespace {

constexpr size_t kMostBytes = 16u << 20;

std::string lower_case_extension(const std::filesystem::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return extension;
}

enum class Format { kYaml, kToml, kTsai, kQualisys, kOpencap, kVicon, kHumaneva };

Format format_of(const std::filesystem::path& path) {
  const std::string extension = lower_case_extension(path);
  if (extension == ".yaml" || extension == ".yml" || extension == ".json") return Format::kYaml;
  if (extension == ".toml") return Format::kToml;
  if (extension == ".xml") return Format::kTsai;
  if (extension == ".pickle" || extension == ".pkl") return Format::kOpencap;
  if (extension == ".xcp") return Format::kVicon;
  if (extension == ".cal") return Format::kHumaneva;
  if (extension == ".txt" && lower_case_extension(path.stem()) == ".qca") return Format::kQualisys;
  throw InputError(
      describe({path.string(), 0, ""}, "'" + extension + "' as calibration",
               ".yaml .yml .json (OpenCV, EasyMocap), .toml (Pose2Sim, Anipose), .xml (Tsai), "
               ".qca.txt (Qualisys), .xcp (Vicon), .pickle (OpenCap), .cal (HumanEva)"));
}

Camera easymocap_camera(const std::filesystem::path& path, const std::string& text,
                        const std::string& name, const std::optional<ImageSize>& size) {
  const std::filesystem::path extrinsic = path.parent_path() / "extri.yml";
  return camera_from_easymocap({text, path.string()},
                               {read_text_file(extrinsic, kMostBytes), extrinsic.string()}, name,
                               size);
}

}  // namespace

Camera read_calibration(const std::filesystem::path& path, const std::string& name,
                        const std::optional<ImageSize>& size) {
  const Format format = format_of(path);
  const std::string file = path.string(), text = read_text_file(path, kMostBytes);
  switch (format) {
    case Format::kToml:
      return camera_from_toml(text, file, name);
    case Format::kTsai:
      return camera_from_tsai(text, file);
    case Format::kQualisys:
      return camera_from_qualisys(text, file, name);
    case Format::kVicon:
      return camera_from_vicon(text, file, name);
    case Format::kHumaneva:
      return camera_from_humaneva(text, file, size);
    case Format::kOpencap:
      return camera_from_opencap(text, file);
    case Format::kYaml:
      break;
  }
  return is_easymocap(text, file) ? easymocap_camera(path, text, name, size)
                                  : camera_from_opencv(text, file);
}

std::vector<std::string> calibration_names(const std::filesystem::path& path) {
  const Format format = format_of(path);
  const std::string file = path.string(), text = read_text_file(path, kMostBytes);
  if (format == Format::kToml) return toml_names(text, file);
  if (format == Format::kQualisys) return qualisys_names(text, file);
  if (format == Format::kVicon) return vicon_names(text, file);
  if (format == Format::kYaml && is_easymocap(text, file)) return easymocap_names(text, file);
  return {};
}

}  // namespace io
}  // namespace walktrack
