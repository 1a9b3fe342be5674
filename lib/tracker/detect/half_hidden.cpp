#include "tracker/detect/half_hidden.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <span>
#include <vector>

#include "body/kinematics.h"
#include "camera/inspection.h"
#include "core/median.h"
#include "observation/silhouette/hidden_pixels.h"

namespace walktrack {
inline namespace tracker {

namespace {

// By hand. A moment, s; the share of the figure that is hidden beyond the usual one when a subject
// is half hidden, and when they are whole again. The usual share is .15 to .3, because people and
// figures differ.
constexpr double kMoment = 0.1;
constexpr double kHidden = 0.1, kWhole = 0.05;

// The frames of a camera with the figures that walk along there.
std::vector<CoveredFrame> covered_frames(const TrackContext& context, const DetectedWalk& walk,
                                         const std::deque<SceneEvidence>& frames, size_t camera) {
  const double heading = std::atan2(walk.velocity.y(), walk.velocity.x());
  std::vector<CoveredFrame> out;
  for (size_t t = 0; t < frames.size(); ++t) {
    CoveredFrame& frame = out.emplace_back(CoveredFrame{&frames[t][camera].planes, {}});
    const double seconds = static_cast<double>(t) * context.scene.dt;
    for (Pose pose : context.subject.figures.at(walk.velocity.norm(), heading)) {
      pose.root.head<2>() = moved(walk, seconds).position;
      pose.heading = heading;
      frame.figures.push_back(
          project_parts(context.scene.cameras[camera],
                        pose_parts(context.body(), forward_kinematics(context.body(), pose))));
    }
  }
  return out;
}

// Number of the first frames in which the subject is half hidden from the camera.
size_t half_hidden_at_first(std::span<const CoveredFrame> frames, double dt) {
  const auto moment = static_cast<size_t>(frames_in(kMoment, dt));
  if (frames.size() < 2 * moment) return 0;
  std::vector<double> shares;
  for (const CoveredFrame& frame : frames) shares.push_back(hidden_share(frame));
  const double usual = median_of(shares);
  const auto beyond_usual = [&](size_t at) {
    const auto from = shares.begin() + static_cast<long>(at), to = from + static_cast<long>(moment);
    return std::accumulate(from, to, 0.0) / static_cast<double>(moment) - usual;
  };
  if (beyond_usual(0) < kHidden) return 0;
  size_t at = 1;
  while (at + moment < shares.size() && beyond_usual(at) >= kWhole) ++at;
  return at;
}

}  // namespace

void hide_occluders(const TrackContext& context, const DetectedWalk& walk, size_t least,
                    std::deque<SceneEvidence>& frames) {
  for (size_t c = 0; c < context.scene.cameras.size(); ++c) {
    const double scale = metres_per_px(context.scene.cameras[c], walk.position);
    const std::vector<CoveredFrame> covered = covered_frames(context, walk, frames, c);
    const std::span<const CoveredFrame> all = covered;
    const size_t half_hidden = half_hidden_at_first(all, context.scene.dt);
    if (scale == 0 || half_hidden == 0) continue;
    const size_t first = std::min(std::max(least, half_hidden), all.size());
    const PixelMask mask = hidden_pixels(all.first(first), all.subspan(first), scale);
    for (SceneEvidence& frame : frames) hide(mask, frame[c].planes);
  }
}

}  // namespace tracker
}  // namespace walktrack
