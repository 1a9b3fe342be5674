#include "tracker/detect/clothes.h"

#include <cmath>

namespace walktrack {
inline namespace tracker {

namespace {

// Of the figures' thickness; the rest may be scene, because figures differ from people. Of 1, .75
// and .5 the last is best on the videos of tracker/reports/one_camera.md.
constexpr double kCertainlyBody = 0.5;
// Metres beside the place, and share of the subject's height in the image on each side, in which a
// subject who is nearer or farther lies as well. By hand; sensitivity not measured.
constexpr double kLimbs = 0.5, kOtherDistance = 0.5;

AppearanceModel unknown_clothes(const TrackContext& context, const SeenColours& seen) {
  return {context.scene.observation.foreground, appearances_of(context.body()), seen.colourless};
}

PixelRect area_around(const TrackContext& context, const Eigen::Vector2d& place,
                      const SeenColours& seen) {
  const PixelRect person =
      person_region(context.scene.cameras[0], place, context.body().subject.height, kLimbs).area;
  const int more = static_cast<int>(std::lround(kOtherDistance * person.height()));
  return intersection({person.x0 - more, person.y0 - more, person.x1 + more, person.y1 + more},
                      seen.area);
}

}  // namespace

std::optional<AppearanceModel> clothes_of(const TrackContext& context,
                                          const std::deque<SceneEvidence>& window,
                                          const DetectedWalk& walk) {
  const ColourBins bins;
  const double heading = std::atan2(walk.velocity.y(), walk.velocity.x());
  const auto figures = context.subject.figures.at(walk.velocity.norm(), heading);
  std::optional<AppearanceModel> clothes;
  for (size_t i = 0; i < window.size(); ++i) {
    const SeenColours& seen = window[i][0].colours;
    if (seen.empty()) continue;
    if (!clothes) clothes = unknown_clothes(context, seen);
    const Eigen::Vector2d place = moved(walk, double(i) * context.scene.dt).position;
    const Pose pose =
        best_figure(context.scene, window[i], context.body(), figures, place, heading).pose;
    const PosedBody figure(context.body(), pose);
    const CapsuleList parts = project_parts(context.scene.cameras[0], figure.parts);
    clothes->learn(bins, colours_inside(scaled_radii(parts, kCertainlyBody), window[i][0].planes,
                                        *clothes, [&](int x, int y) { return seen.bin_at(x, y); }));
  }
  return clothes && clothes->any_learned() ? clothes : std::nullopt;
}

void compare_with(const AppearanceModel& clothes, const TrackContext& context,
                  const Eigen::Vector2d& place, SceneEvidence& frame) {
  const SeenColours& seen = frame[0].colours;
  if (seen.empty()) return;
  compare_with(clothes, seen, area_around(context, place, seen), context.scene.observation.clip,
               frame[0].planes);
}

void forget_clothes(const TrackContext& context, SceneEvidence& frame) {
  const SeenColours& seen = frame[0].colours;
  if (seen.empty()) return;
  compare_with(unknown_clothes(context, seen), seen, seen.area, context.scene.observation.clip,
               frame[0].planes);
}

void drop_colours(SceneEvidence& frame) {
  for (CameraEvidence& each : frame) each.colours = {};
}

}  // namespace tracker
}  // namespace walktrack
