#include "tracker/tracked_subject.h"

#include <utility>

#include "tracker/start/girth.h"

namespace walktrack {
inline namespace tracker {

TrackedSubject::TrackedSubject(TrackerScene stated_scene, const GaitPrior& gait,
                               const TrackerConfig& stated, uint64_t stream_seed, int thread_count)
    : scene(std::move(stated_scene)),
      prior(gait),
      config(stated),
      seed(stream_seed),
      threads(thread_count),
      model(scene.model, prior, config.motion, scene.dt) {
  config.detector = detector_for(scene, config.detector);
  if (must_lead(scene.observation.keypoints)) let_keypoints_lead();
}

void TrackedSubject::let_keypoints_lead() {
  walktrack::let_keypoints_lead(scene.observation);
  config.detector.least_score = config.detector.least_points_score;
}

bool TrackedSubject::wants_girth() const {
  return !scene.girth_known && !girth && scene.cameras.size() == 1 && scene.pictures;
}

void TrackedSubject::set_girth(double wanted) {
  scene.model.body = with_girth(scene.model.body, wanted);
}

void TrackedSubject::set_height(double height, const std::optional<Stature>& estimate) {
  stature = estimate;
  scene.model = with_height(scene.model, height);
  model = SubjectModel(scene.model, prior, config.motion, scene.dt);
}

}  // namespace tracker
}  // namespace walktrack
