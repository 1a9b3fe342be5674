// Positions of the discs at the ends of parts, before lens distortion.
#pragma once

#include "observation/silhouette/part_table.h"

namespace walktrack {
inline namespace observation {

// X/Z and Y/Z in camera axes, by part.
struct FlatPoints {
  alignas(64) double x[kMaxParts], y[kMaxParts];
};

struct FlatEnds {
  FlatPoints middle, rim;
};

}  // namespace observation
}  // namespace walktrack
