// What surfaces look like: two colours and a pattern in space. A pattern is a function of the
// point in the surface's own coordinates (metres), so it moves with what it is on.
#pragma once

#include <cstdint>
#include <vector>

#include <Eigen/Core>

namespace walktrack {
inline namespace synth {

using Colour = Eigen::Vector3f;  // red, green, blue, 0 to 1, as a camera would store them

enum class Pattern {
  kPlain,    // the first colour with a little mottling
  kMottled,  // both colours, mixed by noise
  kStripes,  // bands along the third axis, softly mottled
  kChecks,   // cubes
  kPlanks,   // long tiles across the second axis, each of its own shade
};

struct Material {
  Colour first{0.5f, 0.5f, 0.5f};
  Colour second{0.4f, 0.4f, 0.4f};
  Pattern pattern = Pattern::kPlain;
  double size = 0.1;  // m, of a blotch, band, cube or the width of a plank
};

// Smooth noise in space, drawn from a seed: values on a lattice of unit cells that repeats, between
// them by trilinear interpolation.
class Noise {
 public:
  explicit Noise(uint64_t seed);
  // In [0, 1], continuous.
  float at(const Eigen::Vector3d& point) const;
  // The same summed over four octaves: more natural blotches.
  float rough(const Eigen::Vector3d& point) const;

 private:
  std::vector<float> lattice_;
};

Colour colour_at(const Material& material, const Eigen::Vector3d& point, const Noise& noise);

}  // namespace synth
}  // namespace walktrack
