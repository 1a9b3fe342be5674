// The file of the built-in pose detector's network.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace walktrack {
inline namespace jobs {

// The default of observation.keypoints.model: the network that comes with the program.
inline constexpr std::string_view kShippedModel = "movenet_lightning";

inline constexpr size_t kMaxModelBytes = size_t{256} << 20;

// The file of a model: the shipped one, installed beside the program or in the source tree from
// which it was built, or a path. nullopt if the shipped one is missing.
std::optional<std::filesystem::path> pose_model_file(const std::string& model);

}  // namespace jobs
}  // namespace walktrack
