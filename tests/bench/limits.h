// The limits of this machine: the least code for the same numbers, without the other tasks
// (torques, knee stops, events, any lens, any machine). Compiled for the present machine with all
// optimisations, hence plain types only.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>

namespace walktrack::limits {

// Forward dynamics with gravity and Coriolis forces, angles below pi/2. The model's fields are
// those of KneedModel. Arrays are [coordinate][walker]; `count`, a multiple of 8, is their pitch.
struct Linkage {
  double couple[5][5], skew[5][5], along[5], across[5];
  double radius, total_mass, gravity_x, gravity_z;
};
void accelerations(const Linkage& linkage, size_t count, const double* q, const double* qd,
                   double* qdd);

// The same for two straight legs; StraightModel's sums.
struct Legs {
  double stance_couple, cross_couple, swing_couple, stance_moment, swing_moment;
  double radius, mass, gravity_x, gravity_z;
};
void accelerations(const Legs& legs, size_t count, const double* q, const double* qd, double* qdd);

// A silhouette: edges row by row in single precision, overlaps of parts counted once, one plane of
// prefix sums for all. In pixels.
struct TaperedPart {
  float x[2], y[2], radius[2];
};
struct PrefixPlane {
  int width, height;
  const int32_t* prefix;  // height rows, `pitch` apart, of width + 1
  size_t pitch;
};
int64_t silhouette(const PrefixPlane& plane, std::span<const TaperedPart> parts);

}  // namespace walktrack::limits
