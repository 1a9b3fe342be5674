#include "jobs/track/report/stated_start.h"

#include <algorithm>

#include <fmt/format.h>

namespace walktrack {
inline namespace jobs {

namespace {

// A stated place is right to .1 m (MotionConfig::given_position_sd); more than so much is another
// place, m. By hand.
constexpr double kElsewhere = 0.5;

}  // namespace

std::optional<std::string> stated_start_note(const Motion& motion, const InitialState& stated) {
  const std::string place = fmt::format(
      "the subject was not found at ({:.2f}, {:.2f}) m, where the walk begins according "
      "to the scene (initial)",
      stated.position.x(), stated.position.y());
  constexpr double kSameFrame = 1e-3;  // s
  const auto from = std::ranges::lower_bound(motion.time, stated.time - kSameFrame);
  for (auto time = from; time != motion.time.end(); ++time) {
    const Eigen::Vector3d& pelvis =
        motion.joints[static_cast<size_t>(time - motion.time.begin())][Joint::kPelvis];
    if (!known(pelvis)) continue;
    if (time == from && (pelvis.head<2>() - stated.position).norm() <= kElsewhere) return {};
    return fmt::format("{}; the walk that was found begins at ({:.2f}, {:.2f}) m, at {:.2f} s",
                       place, pelvis.x(), pelvis.y(), *time);
  }
  return place;
}

}  // namespace jobs
}  // namespace walktrack
