// The lens that is assumed for a video that was not calibrated.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

namespace walktrack {
inline namespace jobs {

struct LensGuess {
  double focal_px = 0, focal_sd = 0;
  double fov_deg = 0, fov_sd_deg = 0;  // along the longer side of the image
  std::string from;                    // in words
};

// The stated field of view, otherwise the one from the metadata on the lens, otherwise from the
// telephone's model, otherwise a usual value. `side_px`: length of the longer side.
LensGuess lens_guess(const std::filesystem::path& video, double side_px,
                     const std::optional<double>& stated_fov_deg);

// The field of view for a focal length, along a side of the image, degrees.
double fov_deg_of(double side_px, double focal_px);

}  // namespace jobs
}  // namespace walktrack
