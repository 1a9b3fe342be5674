// The appearance of surfaces: two colours and a pattern in space. A pattern is a function of the
// point in the surface's own coordinates (metres), so that it moves with its object.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace walktrack {
inline namespace synth {

using Colour = Eigen::Vector3f;  // red, green, blue, 0 to 1, as in camera images

enum class Pattern {
  kPlain,    // the first colour with slight noise
  kMottled,  // both colours, mixed by noise
  kStripes,  // bands along the third axis, with slight noise
  kChecks,   // cubes
  kPlanks,   // long tiles across the second axis, each with a shade of its own
};

struct Material {
  Colour first{0.5f, 0.5f, 0.5f};
  Colour second{0.4f, 0.4f, 0.4f};
  Pattern pattern = Pattern::kPlain;
  double size = 0.1;  // m, size of a spot, band or cube, or width of a plank
};

// Smooth noise in space from a seed: values on a periodic lattice of unit cells, with trilinear
// interpolation between them.
class Noise {
 public:
  explicit Noise(uint64_t seed);
  // In [0, 1], continuous.
  float at(const Eigen::Vector3d& point) const;
  // The sum over four octaves, which looks more natural.
  float rough(const Eigen::Vector3d& point) const;

 private:
  std::vector<float> lattice_;
};

Colour colour_at(const Material& material, const Eigen::Vector3d& point, const Noise& noise);

}  // namespace synth
}  // namespace walktrack
