// The subject of a tracker in its scene: what is stated, and what the search of a walk adds to it,
// which is the height, the girth, the length of the trunk, and whether keypoints lead.
#pragma once

#include <optional>

#include "tracker/detect/stature.h"
#include "tracker/figure/girth.h"
#include "tracker/figure/trunk_length.h"
#include "tracker/start/keypoint_lead.h"
#include "tracker/subject_model.h"

namespace walktrack {
inline namespace tracker {

// What a track has estimated of the subject; nullopt: it is stated, or a usual one.
struct SubjectEstimates {
  std::optional<Stature> stature{};
  std::optional<double> girth{};  // Subject::girth
  std::optional<double> trunk{};  // SubjectLengths::trunk, m

  bool any() const { return stature || girth || trunk; }
};

struct TrackedSubject {
  TrackedSubject(TrackerScene stated_scene, const GaitPrior& gait, const TrackerConfig& stated,
                 uint64_t stream_seed, int thread_count);

  TrackContext context() const { return {scene, prior, config, model, seed, threads}; }
  // Whether the height is unknown and has not been estimated yet.
  bool wants_size() const { return !scene.size_known && !stature; }
  // `estimate`: nullopt if the height is not estimated.
  void set_height(double height, const std::optional<Stature>& estimate);
  // Whether a start before one camera may widen the figure (tracker/figure/girth.h), or give it
  // another trunk (tracker/figure/trunk_length.h); the first one that succeeds decides.
  bool wants_girth() const;
  bool wants_trunk() const;
  void set_girth(double wanted) { scene.model.body = with_girth(scene.model.body, wanted); }
  // m; nullopt: the usual length.
  void set_trunk(std::optional<double> length) {
    scene.model.body = with_trunk(scene.model.body, length);
  }
  SubjectEstimates estimates() const;
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
  bool shape_decided = false;      // by the first start

 private:
  bool wants_shape() const { return !shape_decided && scene.cameras.size() == 1 && scene.pictures; }
};

}  // namespace tracker
}  // namespace walktrack
