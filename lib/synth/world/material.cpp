#include "synth/world/material.h"

#include <cmath>

#include "core/rng.h"

namespace walktrack {
inline namespace synth {

namespace {

constexpr int kCells = 32;           // a power of two, so that a bit mask repeats the lattice
constexpr float kMottling = 0.12f;   // share of the brightness; by hand
constexpr double kPlankLength = 12;  // in units of the width

size_t cell(int x, int y, int z) {
  const auto wrap = [](int i) { return static_cast<size_t>(i & (kCells - 1)); };
  return (wrap(z) * kCells + wrap(y)) * kCells + wrap(x);
}

float mix(float a, float b, float share) { return a + share * (b - a); }
Colour mix(const Colour& a, const Colour& b, float share) { return a + share * (b - a); }

int parity(double x) { return static_cast<int>(std::floor(x)) & 1; }

// The shade in [0, 1] of the plank at a point; joints between planks are dark.
float plank_shade(const Eigen::Vector3d& p, const Noise& noise) {
  const double row = std::floor(p.y());
  const double along = p.x() / kPlankLength + 0.37 * row;
  const double edge_y = p.y() - row, edge_x = (along - std::floor(along)) * kPlankLength;
  if (edge_y < 0.03 || edge_x < 0.03) return 1;
  const Eigen::Vector3d plank(3.7 * row, 5.1 * std::floor(along), 0);
  const Eigen::Vector3d grain(0.4 * p.x(), 6 * p.y(), 0);
  return 0.55f * noise.at(plank) + 0.3f * noise.at(grain);
}

}  // namespace

Noise::Noise(uint64_t seed) : lattice_(size_t{kCells} * kCells * kCells) {
  Rng rng(seed, Purpose::kRendering);
  for (float& value : lattice_) value = static_cast<float>(rng.uniform());
}

float Noise::at(const Eigen::Vector3d& point) const {
  const Eigen::Vector3d low = point.array().floor();
  const Eigen::Vector3f s = (point - low).cast<float>();
  const int x = static_cast<int>(low.x()), y = static_cast<int>(low.y()),
            z = static_cast<int>(low.z());
  const auto edge = [&](int dy, int dz) {
    return mix(lattice_[cell(x, y + dy, z + dz)], lattice_[cell(x + 1, y + dy, z + dz)], s.x());
  };
  return mix(mix(edge(0, 0), edge(1, 0), s.y()), mix(edge(0, 1), edge(1, 1), s.y()), s.z());
}

float Noise::rough(const Eigen::Vector3d& point) const {
  float sum = 0, weight = 0.5f;
  Eigen::Vector3d p = point;
  for (int octave = 0; octave < 4; ++octave, weight *= 0.5f) {
    sum += weight * at(p);
    // Octaves are shifted relative to each other, so that their lattices do not coincide.
    p = 2.03 * p + Eigen::Vector3d(7.1, 3.3, 5.7);
  }
  return sum / 0.9375f;
}

Colour colour_at(const Material& material, const Eigen::Vector3d& point, const Noise& noise) {
  const Eigen::Vector3d p = point / material.size;
  float share = 0;
  switch (material.pattern) {
    case Pattern::kPlain:
      share = kMottling * noise.rough(2 * p);
      break;
    case Pattern::kMottled:
      share = noise.rough(p);
      break;
    case Pattern::kStripes:
      share = mix(static_cast<float>(parity(p.z())), noise.rough(p), kMottling);
      break;
    case Pattern::kChecks:
      share = mix(static_cast<float>(parity(p.x()) ^ parity(p.y()) ^ parity(p.z())), noise.rough(p),
                  kMottling);
      break;
    case Pattern::kPlanks:
      share = plank_shade(p, noise);
      break;
  }
  return mix(material.first, material.second, share);
}

}  // namespace synth
}  // namespace walktrack
