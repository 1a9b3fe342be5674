#include "tracker/detect/slight_walks.h"

#include <cmath>

namespace walktrack {
inline namespace tracker {

namespace {

// Lower shares of the score by which a walk is better than standing are no evidence. By hand.
constexpr double kSlightShare = 0.02;
// A walk moves on if its middle moves by at least this share of what its velocity says, over so
// many seconds. By hand.
constexpr double kMovesOn = 0.5, kMovesOnFor = 0.75;

}  // namespace

bool walks_on(uint32_t first_frame, const DetectedWalk& walk, double seconds, double dt,
              SlightWalks& walks) {
  if (walk.over_standing < kSlightShare) {
    walks.moved_on_from.reset();
    return false;
  }
  if (walks.moved_on_from && first_frame >= *walks.moved_on_from) return true;
  const auto elapsed_since = [&](const SlightWalk& then) {
    return dt * (static_cast<double>(first_frame) - static_cast<double>(then.first_frame));
  };
  std::erase_if(walks.newest,
                [&](const SlightWalk& then) { return std::abs(elapsed_since(then)) > seconds; });
  const Eigen::Vector2d middle = moved(walk, 0.5 * seconds).position;
  if (walks.newest.empty() || walks.newest.back().first_frame < first_frame)
    walks.newest.push_back({first_frame, middle});
  const SlightWalk& then = walks.newest.front();
  const double elapsed = elapsed_since(then);
  const double way = (middle - then.middle).dot(walk.velocity.normalized());
  if (elapsed >= kMovesOnFor && way >= kMovesOn * elapsed * walk.velocity.norm())
    walks.moved_on_from = then.first_frame;
  return walks.moved_on_from.has_value();
}

}  // namespace tracker
}  // namespace walktrack
