// Where the network of the built-in pose detector is.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace walktrack {
inline namespace jobs {

// What observation.keypoints.model says by default: the network that comes with the program.
inline constexpr std::string_view kShippedModel = "movenet_lightning";

inline constexpr size_t kMaxModelBytes = size_t{256} << 20;

// The file of a model: the shipped one, installed beside the program or in the source tree that it
// was built in, or a path. Nothing when the shipped one is not there.
std::optional<std::filesystem::path> pose_model_file(const std::string& model);

}  // namespace jobs
}  // namespace walktrack
