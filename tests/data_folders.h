// Where tests find files that they do not make.
#pragma once

#include <filesystem>
#include <string>

namespace walktrack {

// The shipped demo.
inline const std::filesystem::path kDemo =
    std::filesystem::path(WALKTRACK_SOURCE_DIR) / "data/demo";
// A configuration with which whatever is tracked passes all quality checks.
inline const std::string kAnyQuality = WALKTRACK_SOURCE_DIR "/tests/any_quality.yaml";
// Recordings that are not part of the product; tests of them skip, visibly, where they are absent.
inline const std::filesystem::path kSharedData =
    std::filesystem::path(WALKTRACK_SOURCE_DIR) / "../shared/data";

}  // namespace walktrack
