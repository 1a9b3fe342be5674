#include "jobs/init/lens_guess.h"

#include <cmath>

#include <fmt/format.h>

#include "core/conventions.h"
#include "io/video/lens_facts.h"

namespace walktrack {
inline namespace jobs {

namespace {

// Field of view along the longer side. The main cameras of telephones have 24 to 28 mm (equivalents
// of 35 mm film); video stabilisation crops up to a tenth of the image.
constexpr double kUsualFov_deg = 64, kUsualFovSd_deg = 8, kStatedFovSd_deg = 1;
constexpr double kFilmDiagonal_mm = 43.27, kSensorAspect = 0.8;  // aspect ratio of 3:4: the longer
                                                                 // side's share of the diagonal
constexpr double kStabilisationCrop = 1.05, kStabilisationCropSd = 0.05;
// Spread if only the telephone's model is known: another of its cameras may have been used, or a
// crop of the image.
constexpr double kNamedSd = 0.08;

double focal_of(double side_px, double fov_deg) {
  return 0.5 * side_px / std::tan(0.5 * rad_from_deg(fov_deg));
}

LensGuess guess_of(double side_px, double fov_deg, double sd_deg, std::string from) {
  const double focal = focal_of(side_px, fov_deg);
  return {focal, std::abs(focal_of(side_px, fov_deg - sd_deg) - focal), fov_deg, sd_deg,
          std::move(from)};
}

LensGuess guess_of_film(double side_px, double film_mm, double sd, std::string from) {
  const double focal = side_px * film_mm / (kSensorAspect * kFilmDiagonal_mm) * kStabilisationCrop;
  const double fov = fov_deg_of(side_px, focal);
  return {focal, focal * sd, fov, fov - fov_deg_of(side_px, focal * (1 + sd)), std::move(from)};
}

}  // namespace

double fov_deg_of(double side_px, double focal_px) {
  return 2 * deg_from_rad(std::atan(0.5 * side_px / focal_px));
}

LensGuess lens_guess(const std::filesystem::path& video, double side_px,
                     const std::optional<double>& stated_fov_deg) {
  if (stated_fov_deg) return guess_of(side_px, *stated_fov_deg, kStatedFovSd_deg, "as stated");
  if (const auto film_mm = focal_length_35mm(video))
    return guess_of_film(side_px, *film_mm, kStabilisationCropSd,
                         fmt::format("of the file, {:g} mm (35 mm film)", *film_mm));
  const std::string model = camera_model(video);
  if (const auto film_mm = telephone_focal_length_35mm(model))
    return guess_of_film(
        side_px, *film_mm, kNamedSd,
        fmt::format("of the main camera of {}, {:g} mm (35 mm film)", model, *film_mm));
  return guess_of(side_px, kUsualFov_deg, kUsualFovSd_deg,
                  "that of a usual telephone; state yours with --fov-deg");
}

}  // namespace jobs
}  // namespace walktrack
