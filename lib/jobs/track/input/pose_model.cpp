#include "jobs/track/input/pose_model.h"

#include <array>

namespace walktrack {
inline namespace jobs {

namespace fs = std::filesystem;

std::optional<fs::path> pose_model_file(const std::string& model) {
  if (model != kShippedModel) return model;
  constexpr std::array kFolders{"../share/walktrack/pose_net", "../../data/pose_net"};
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error).parent_path();
  for (const char* folder : kFolders) {
    const fs::path file = (program / folder / (model + ".onnx")).lexically_normal();
    if (fs::is_regular_file(file, error)) return file;
  }
  return std::nullopt;
}

}  // namespace jobs
}  // namespace walktrack
