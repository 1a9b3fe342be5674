// The subject of a tracker in its scene: what is stated, and what the search of a walk adds to it,
// which is the height, the girth, and whether keypoints lead.
#pragma once

#include <optional>

#include "tracker/detect/stature.h"
#include "tracker/start/keypoint_lead.h"
#include "tracker/subject_model.h"

namespace walktrack {
inline namespace tracker {

struct TrackedSubject {
  TrackedSubject(TrackerScene stated_scene, const GaitPrior& gait, const TrackerConfig& stated,
                 uint64_t stream_seed, int thread_count);

  TrackContext context() const { return {scene, prior, config, model, seed, threads}; }
  // Whether the height is unknown and has not been estimated yet.
  bool wants_size() const { return !scene.size_known && !stature; }
  // `estimate`: nullopt if the height is not estimated.
  void set_height(double height, const std::optional<Stature>& estimate);
  // Whether a start before one camera may widen the figure (tracker/start/girth.h); the first one
  // that succeeds decides.
  bool wants_girth() const;
  void set_girth(double wanted);
  // Whether others near the subject are followed, whom outlines show.
  bool follows_others() const { return config.others && scene.pictures; }
  // Whether keypoints count for more than outlines (tracker/start/keypoint_lead.h).
  bool keypoints_lead() const { return walktrack::keypoints_lead(scene.observation); }
  // From now on. A walk is then found by as little evidence as if there were keypoints alone.
  void let_keypoints_lead();

  TrackerScene scene;
  const GaitPrior& prior;
  TrackerConfig config;
  uint64_t seed;
  int threads;
  SubjectModel model;              // for the scene's body
  std::optional<Stature> stature;  // the estimated height
  std::optional<double> girth;     // that of the first start before one camera, if it was unknown
};

}  // namespace tracker
}  // namespace walktrack
