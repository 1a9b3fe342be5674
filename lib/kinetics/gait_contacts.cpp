#include "kinetics/gait_contacts.h"

#include <algorithm>

namespace walktrack {
inline namespace kinetics {

namespace {

constexpr double kUsualDoubleSupport = 0.12;  // s

// Mean time from a strike to the other foot's toe-off, if both are events.
double double_support(const Gait& gait) {
  double sum = 0;
  size_t count = 0;
  for (const Stance& leading : gait.stances) {
    for (const Stance& trailing : gait.stances) {
      if (leading.side == trailing.side || !leading.starts_in_motion || !trailing.ends_in_motion)
        continue;
      if (trailing.on >= leading.on || trailing.off <= leading.on) continue;
      sum += trailing.off - leading.on;
      ++count;
    }
  }
  return count > 0 ? sum / static_cast<double>(count) : kUsualDoubleSupport;
}

}  // namespace

std::vector<FootContact> foot_contacts(const Gait& gait) {
  const double shared = double_support(gait);
  std::vector<FootContact> out;
  for (const Stance& stance : gait.stances) {
    FootContact contact{stance.side, stance.on, stance.off};
    for (const Stance& each : gait.stances) {
      if (each.side == stance.side) continue;
      const bool overlaps = each.on < stance.off && stance.on < each.off;
      if (!overlaps) continue;
      if (!stance.ends_in_motion && each.starts_in_motion && each.on > stance.on)
        contact.off = std::min(contact.off, each.on + shared);
      if (!stance.starts_in_motion && each.ends_in_motion && each.off < stance.off)
        contact.on = std::max(contact.on, each.off - shared);
    }
    out.push_back(contact);
  }
  return out;
}

}  // namespace kinetics
}  // namespace walktrack
