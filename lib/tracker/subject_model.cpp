#include "tracker/subject_model.h"

#include "tracker/motion/models/make_motion_model.h"

namespace walktrack {
inline namespace tracker {

SubjectModel::SubjectModel(const BodyModel& model, const GaitPrior& prior,
                           const MotionConfig& config, double dt)
    : motion(to_scale(config, model.body.subject.height)),
      moves(make_motion_model(motion.model, model, prior)),
      frame_scale(noise_scale(*moves, motion, model, dt)),
      markov(markov_steps(*moves, motion, dt)),
      figures(model, prior) {
  // The other models have no walker, or none that can stand.
  if (may_stand(motion)) standing = standing_process(*moves, motion, dt);
}

WalkerFilterContext filter_context(const TrackContext& context) {
  const SubjectModel& subject = context.subject;
  return {context.scene,
          {context.scene.model, context.prior, *subject.moves, subject.motion, subject.frame_scale,
           subject.markov, context.scene.dt, subject.standing ? &*subject.standing : nullptr,
           context.all_set_off},
          context.config.samples,
          context.threads,
          context.config.model_error};
}

WalkerFilterContext first_filter_context(const TrackContext& context) {
  WalkerFilterContext out = filter_context(context);
  MotionContext& motion = out.motion;
  motion.scale = start_scale(context.config.start, motion.moves, motion.config, motion.scale);
  return out;
}

}  // namespace tracker
}  // namespace walktrack
