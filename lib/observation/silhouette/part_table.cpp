#include "observation/silhouette/part_table.h"

#include <algorithm>
#include <stdexcept>

namespace walktrack {
inline namespace observation {

namespace {

void set(VectorTable& table, size_t i, const Eigen::Vector3d& v) {
  table.x[i] = v.x();
  table.y[i] = v.y();
  table.z[i] = v.z();
}

void set(SectionTable& table, size_t i, const CrossSection& section) {
  table.lateral[i] = section.lateral;
  table.forward[i] = section.forward;
}

}  // namespace

void fill_table(std::span<const PosedPart> parts, PartTable& table) {
  if (parts.size() > kMaxParts) throw std::length_error("more parts than kMaxParts");
  table.count = (parts.size() + kPartVector - 1) / kPartVector * kPartVector;
  for (size_t i = 0; i < table.count; ++i) {
    const PosedPart& part = parts[std::min(i, parts.size() - 1)];
    set(table.lower, i, part.lower);
    set(table.upper, i, part.upper);
    set(table.lateral, i, part.lateral);
    set(table.forward, i, part.forward);
    set(table.at_lower, i, part.at_lower);
    set(table.at_upper, i, part.at_upper);
  }
}

}  // namespace observation
}  // namespace walktrack
