// Folders of files that tests do not make themselves.
#pragma once

#include <filesystem>
#include <string>

namespace walktrack {

// The shipped demo.
inline const std::filesystem::path kDemo =
    std::filesystem::path(WALKTRACK_SOURCE_DIR) / "data/demo";
// A configuration with which every track passes all quality checks.
inline const std::string kAnyQuality = WALKTRACK_SOURCE_DIR "/tests/any_quality.yaml";
// Recordings that are not part of the product; tests of them are skipped if they are missing.
inline const std::filesystem::path kSharedData =
    std::filesystem::path(WALKTRACK_SOURCE_DIR) / "../shared/data";

}  // namespace walktrack
