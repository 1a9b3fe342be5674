// Everything that follows from the body that is tracked, and that all frames of a scene share.
#pragma once

#include <memory>
#include <optional>

#include "tracker/motion/standing.h"
#include "tracker/tracker_config.h"
#include "tracker/tracker_scene.h"
#include "tracker/walker_filter.h"

namespace walktrack {
inline namespace tracker {

struct SubjectModel {
  SubjectModel(const BodyModel& model, const GaitPrior& prior, const MotionConfig& config,
               double dt);

  MotionConfig motion;  // at the body's scale
  std::unique_ptr<const MotionModel> moves;
  NoiseScale frame_scale;
  MarkovSteps markov;
  std::optional<StandingProcess> standing;
  PoseTemplates figures;
};

struct TrackContext {
  const TrackerScene& scene;
  const GaitPrior& prior;
  const TrackerConfig& config;
  const SubjectModel& subject;  // for the scene's body
  uint64_t seed;
  int threads;
  bool competing = true;  // whether components may compete with a track (tracker/modes/turning.h)
  bool all_set_off = false;  // all particles that stand start to walk (tracker/start/set_off.h)

  const Body& body() const { return scene.model.body; }
};

// The context of a frame for the filter.
WalkerFilterContext filter_context(const TrackContext& context);
// The same for the first frame around a walk, whose noise is as wide as the walk is uncertain.
WalkerFilterContext first_filter_context(const TrackContext& context);

}  // namespace tracker
}  // namespace walktrack
