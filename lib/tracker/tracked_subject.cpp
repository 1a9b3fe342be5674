#include "tracker/tracked_subject.h"

#include <utility>

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

bool TrackedSubject::wants_girth() const { return !scene.girth_known && wants_shape(); }

bool TrackedSubject::wants_trunk() const {
  return !scene.trunk_known && scene.size_known && !keypoints_lead() && wants_shape();
}

SubjectEstimates TrackedSubject::estimates() const {
  const Subject& now = scene.model.body.subject;
  return {stature, scene.girth_known || now.girth == 1 ? std::nullopt : std::optional(now.girth),
          scene.trunk_known ? std::nullopt : now.lengths.trunk};
}

void TrackedSubject::set_height(double height, const std::optional<Stature>& estimate) {
  stature = estimate;
  scene.model = with_height(scene.model, height);
  model = SubjectModel(scene.model, prior, config.motion, scene.dt);
}

}  // namespace tracker
}  // namespace walktrack
