// The lens that is assumed for a video that was not calibrated.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace walktrack {
inline namespace jobs {

struct LensGuess {
  double focal_px = 0, focal_sd = 0;
  double fov_deg = 0, fov_sd_deg = 0;  // along the longer side of the picture
  std::string from;                    // in words
};

// As stated, else by what the file says of its lens, else by its telephone, else a usual one.
// `side_px`: of the longer side.
LensGuess lens_guess(const std::filesystem::path& video, double side_px,
                     const std::optional<double>& stated_fov_deg);

// The field of view of a focal length, along a side of the picture, degrees.
double fov_deg_of(double side_px, double focal_px);

}  // namespace jobs
}  // namespace walktrack
