// Common parts of the scenes and records that `walktrack init` writes for one and for two videos.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <nlohmann/json_fwd.hpp>

#include "camera/view_from_walker.h"

namespace walktrack {
inline namespace jobs {

inline constexpr const char *kInitScene = "scene.yaml", *kInitPicture = "init.png",
                            *kInitRecord = "init.json";

// "1.32 (± 0.04)", in units of `factor`: two standard deviations.
std::string band(const Measured& of, double factor, int digits);

// A file's path relative to the scene's folder, in quotes.
std::string path_beside(const std::filesystem::path& file, const std::filesystem::path& folder);

// The scene's line about the subject.
std::string subject_line(double height, const std::optional<double>& mass);

// Value and standard deviation, in units of `factor`.
nlohmann::ordered_json measured_json(const Measured& of, double factor = 1);

}  // namespace jobs
}  // namespace walktrack
