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
// It is believed for so many lengths of a window; after that it may be somebody else. By hand.
constexpr double kBelieved = 2;

}  // namespace

bool walks_on(uint32_t first_frame, const DetectedWalk& walk, double seconds, double dt,
              SlightWalks& walks) {
  if (walk.over_standing < kSlightShare) {
    walks.moved_on_from.reset();
    return false;
  }
  const auto elapsed_since = [&](uint32_t frame) {
    return dt * (static_cast<double>(first_frame) - static_cast<double>(frame));
  };
  if (walks.moved_on_from) {
    const double since = elapsed_since(*walks.moved_on_from);
    if (since >= 0 && since <= kBelieved * seconds) return true;
    walks.moved_on_from.reset();
  }
  std::erase_if(walks.newest, [&](const SlightWalk& then) {
    return std::abs(elapsed_since(then.first_frame)) > seconds;
  });
  const Eigen::Vector2d middle = moved(walk, 0.5 * seconds).position;
  if (walks.newest.empty() || walks.newest.back().first_frame < first_frame)
    walks.newest.push_back({first_frame, middle});
  const SlightWalk& then = walks.newest.front();
  const double elapsed = elapsed_since(then.first_frame);
  const double way = (middle - then.middle).dot(walk.velocity.normalized());
  if (elapsed >= kMovesOnFor && way >= kMovesOn * elapsed * walk.velocity.norm())
    walks.moved_on_from = then.first_frame;
  return walks.moved_on_from.has_value();
}

}  // namespace tracker
}  // namespace walktrack
