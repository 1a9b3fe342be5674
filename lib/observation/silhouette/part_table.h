// Coordinates of posed parts in the layout for vector code.
#pragma once

#include <span>

#include "body/kinematics.h"

namespace walktrack {
inline namespace observation {

// The widest vector, in doubles. Vectors are complete: the lanes after the last part repeat it.
inline constexpr size_t kPartVector = 8;

struct VectorTable {
  alignas(64) double x[kMaxParts], y[kMaxParts], z[kMaxParts];
};

struct SectionTable {
  alignas(64) double lateral[kMaxParts], forward[kMaxParts];
};

// Discs in the image, px.
struct DiscTable {
  alignas(64) double x[kMaxParts], y[kMaxParts], radius[kMaxParts];
};

struct PartTable {
  size_t count = 0;  // number of complete vectors
  VectorTable lower, upper, lateral, forward;
  SectionTable at_lower, at_upper;
};

// Throws std::length_error for more than kMaxParts parts. No parts: count 0.
void fill_table(std::span<const PosedPart> parts, PartTable& table);

}  // namespace observation
}  // namespace walktrack
