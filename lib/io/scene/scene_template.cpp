#include "io/scene/scene_template.h"

#include <algorithm>
#include <array>
#include <cctype>

#include <fmt/format.h>
#include <yaml-cpp/yaml.h>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/config/yaml.h"

namespace walktrack {
inline namespace io {

namespace fs = std::filesystem;

std::string scene_for_video(const fs::path& scene_template, const fs::path& video) {
  const YamlValue checked = YamlValue::from_file(scene_template.string());
  const YamlValue cameras = checked.at("cameras");
  if (cameras.items().size() != 1) {
    cameras.fail(fmt::format("{} cameras", cameras.items().size()),
                 "one camera in a scene that serves many videos");
  }
  if (!cameras.items()[0].is_map()) cameras.fail("no camera", "a camera");
  YAML::Node root = YAML::Load(read_text_file(scene_template, kMaxYamlBytes));
  YAML::Node camera = root["cameras"][0];
  const fs::path folder = fs::absolute(scene_template).parent_path();
  for (const char* key : {"calibration", "background"}) {
    if (!cameras.items()[0].has(key)) continue;
    camera[key] = resolved(folder, cameras.items()[0].at(key).text()).string();
  }
  camera["video"] = fs::absolute(video).lexically_normal().string();
  root.remove("truth");
  YAML::Emitter text;
  text << root;
  return fmt::format("{}\n", text.c_str());
}

bool is_video_file(const fs::path& path) {
  std::string extension = path.extension().string();
  std::transform(extension.begin(), extension.end(), extension.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  constexpr std::array kKnown{".mp4", ".m4v", ".mov",  ".avi", ".mkv",
                              ".mpg", ".mts", ".mpeg", ".webm"};
  return std::find(kKnown.begin(), kKnown.end(), extension) != kKnown.end();
}

}  // namespace io
}  // namespace walktrack
