// The places over the ground at which a walking figure explains one frame best: the candidates
// through which lines are tried (tracker/detect/detector.h).
#pragma once

#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include <Eigen/Core>

#include "camera/camera.h"
#include "tracker/detect/detector_config.h"

namespace walktrack {
inline namespace tracker {

struct Place {
  Eigen::Vector2d position;
  double score;  // nats
};

// Log-likelihood ratio of the walking figure over a ground point, all cameras together, nats.
using PlaceScore = std::function<double(const Eigen::Vector2d&)>;

// Height in the image, px, of a person of this height who stands at a place on the ground; 0 if the
// place is not in front of the camera.
double height_px(const Camera& camera, const Eigen::Vector2d& position, double height);

// The heading that shows a figure over `position` side on to the camera.
double side_on_heading(const Camera& camera, const Eigen::Vector2d& position);

// Ground points under the pixel grid of `cameras[0]` at which the figure lies wholly inside the
// image of every camera that has the point in front of it.
struct PlaceGrid {
  std::vector<Eigen::Vector2d> places;
  // By place: those of every second row and column beside it, as indices; none for these
  // themselves, at the border, and where the figure is not much larger than the grid.
  std::vector<std::vector<uint32_t>> guides;
};
PlaceGrid place_grid(std::span<const Camera> cameras, double height, const DetectorConfig& config);
std::vector<Eigen::Vector2d> standing_places(std::span<const Camera> cameras, double height,
                                             const DetectorConfig& config);

// The best of the places, at least half a metre apart, best first. A place whose guides all explain
// much less than an empty scene is not tried.
std::vector<Place> find_figures(const PlaceScore& score, const PlaceGrid& grid,
                                const DetectorConfig& config, int threads);

}  // namespace tracker
}  // namespace walktrack
