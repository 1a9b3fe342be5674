// The kernels of straight_lanes.h for every instruction set; equations in straight_walker.h.
#include "walker/straight/straight_lanes.h"

#include "walker/kneed/kneed_incidents.h"
#include "walker/lanes/lane_targets.h"
#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "walker/straight/straight_lanes.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway requires.
#include "walker/lanes/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace walktrack {
inline namespace walker {
namespace HWY_NAMESPACE {
namespace {

using LegsMotion = MotionOf<2>;

struct LegsSetting {
  const StraightModel& model;
  const StraightLanes& lanes;
};

struct LegsMass {
  V m00, m01, m11;
};

struct LegsTurned {
  SineCosine stance, swing;
};

HWY_INLINE LegsTurned turned(const V (&q)[2]) { return {sine_cosine(q[0]), sine_cosine(q[1])}; }

HWY_INLINE LegsMass mass_of(const StraightModel& m, const LegsTurned& t) {
  const V cosine =
      hn::MulAdd(t.stance.cosine, t.swing.cosine, hn::Mul(t.stance.sine, t.swing.sine));
  return {hn::MulAdd(all(2 * m.radius * m.stance_moment), t.stance.cosine,
                     all(m.stance_couple + m.radius * m.radius * m.mass)),
          hn::MulAdd(all(m.cross_couple), cosine,
                     hn::Mul(all(m.radius * m.swing_moment), t.swing.cosine)),
          all(m.swing_couple)};
}

HWY_INLINE V determinant(const LegsMass& m) {
  return hn::NegMulAdd(m.m01, m.m01, hn::Mul(m.m00, m.m11));
}

HWY_INLINE void accelerations(const LegsSetting& at, const LegsMotion& motion, V (&qdd)[2]) {
  const Tag d;
  const StraightModel& p = at.model;
  const LegsTurned t = turned(motion.q);
  const LegsMass m = mass_of(p, t);
  const auto weight = [&](double moment, const SineCosine& leg) {
    return hn::MulAdd(all(moment * p.gravity_x), leg.cosine,
                      hn::Mul(all(-moment * p.gravity_z), leg.sine));
  };
  const V square0 = hn::Mul(motion.qd[0], motion.qd[0]);
  const V square1 = hn::Mul(motion.qd[1], motion.qd[1]);
  const V sine =
      hn::NegMulAdd(t.stance.sine, t.swing.cosine, hn::Mul(t.stance.cosine, t.swing.sine));
  const V pull = hn::Mul(all(p.cross_couple), sine);
  const V hip = hn::Mul(hn::Load(d, at.lanes.stiffness[0]), hn::Sub(motion.q[0], motion.q[1]));
  const V sway = hn::MulAdd(
      hn::Mul(all(p.stance_moment), t.stance.sine), square0,
      hn::MulAdd(hn::Mul(all(p.swing_moment), t.swing.sine), square1, all(p.gravity_x * p.mass)));
  V f0 = hn::Add(hn::Load(d, at.lanes.noise[0]), hn::Sub(weight(p.stance_moment, t.stance), hip));
  V f1 = hn::Add(hn::Load(d, at.lanes.noise[1]), hn::Add(weight(p.swing_moment, t.swing), hip));
  f0 = hn::MulAdd(all(p.radius), sway, hn::MulAdd(pull, square1, f0));
  f1 = hn::NegMulAdd(pull, square0, f1);
  const V inverse = hn::Div(all(1), determinant(m));
  qdd[0] = hn::Mul(inverse, hn::NegMulAdd(m.m01, f1, hn::Mul(m.m11, f0)));
  qdd[1] = hn::Mul(inverse, hn::NegMulAdd(m.m01, f0, hn::Mul(m.m00, f1)));
}

HWY_INLINE LegsMotion motion_at(const StraightLanePoint& at) {
  LegsMotion motion;
  load(at.q, motion.q);
  load(at.qd, motion.qd);
  return motion;
}

struct LegsArrival {
  LegsMotion motion;
  V qdd[2];
};

HWY_INLINE LegsArrival arrive(const StraightModel& model, const StraightLanes& lanes, V h) {
  const LegsSetting at{model, lanes};
  V qdd[2];
  load(lanes.at.qdd, qdd);
  LegsArrival to;
  rk4(at, motion_at(lanes.at), qdd, h, to.motion);
  accelerations(at, to.motion, to.qdd);
  return to;
}

void evaluate(const StraightModel& model, StraightLanes& lanes) {
  V qdd[2];
  accelerations(LegsSetting{model, lanes}, motion_at(lanes.at), qdd);
  store(qdd, lanes.at.qdd);
}

// Frequency^2 = stiffness a' M^-1 a with a = (1, -1).
void step_sizes(const StraightModel& model, const StraightLanes& lanes, double max_step,
                double* sizes) {
  const LegsMass m = mass_of(model, turned(motion_at(lanes.at).q));
  const V sum = hn::MulAdd(all(2), m.m01, hn::Add(m.m00, m.m11));
  const V square =
      hn::Mul(hn::Abs(hn::Load(Tag(), lanes.stiffness[0])), hn::Div(sum, determinant(m)));
  hn::Store(hn::Min(all(max_step), hn::Div(all(kStepReach), hn::Sqrt(square))), Tag(), sizes);
}

void step_to(const StraightModel& model, const StraightLanes& lanes, const double* h,
             StraightLanePoint& end) {
  const LegsArrival to = arrive(model, lanes, hn::Load(Tag(), h));
  store(to.motion.q, end.q);
  store(to.motion.qd, end.qd);
  store(to.qdd, end.qdd);
}

void next_steps(const StraightLanes& lanes, double* h) {
  V remaining;
  hn::Store(next_step(lanes, remaining), Tag(), h);
}

HWY_INLINE Mask is_sound(const LegsArrival& to) {
  V sum = hn::Zero(Tag()), fastest = sum;
  for (int k = 0; k < 2; ++k) {
    sum = hn::Add(sum, hn::Add(hn::Abs(to.motion.q[k]), hn::Abs(to.qdd[k])));
    fastest = hn::Max(fastest, hn::Abs(to.motion.qd[k]));
    sum = hn::Add(sum, hn::Abs(to.motion.qd[k]));
  }
  return hn::And(hn::Lt(fastest, all(kMaxRate)), hn::Lt(sum, all(1e300)));  // false for NaN
}

// The sum of the legs' angles rises through zero and the swing foot is in front afterwards.
HWY_INLINE Mask may_strike(const StraightLanePoint& from, const LegsArrival& to) {
  const Tag d;
  const V none = hn::Zero(d);
  const Mask before = hn::Lt(hn::Add(hn::Load(d, from.q[0]), hn::Load(d, from.q[1])), none);
  const Mask after = hn::Ge(hn::Add(to.motion.q[0], to.motion.q[1]), none);
  return hn::And(hn::And(before, after), hn::Gt(to.motion.q[0], to.motion.q[1]));
}

LaneVerdict sub_step(const StraightModel& model, StraightLanes& lanes) {
  const Tag d;
  V remaining;
  const V h = next_step(lanes, remaining);
  const LegsArrival to = arrive(model, lanes, h);
  const Mask live = hn::Ne(hn::Load(d, lanes.live[0]), hn::Zero(d)), sound = is_sound(to);
  const Mask event = may_strike(lanes.at, to);
  const Mask good = hn::And(live, sound), go = hn::AndNot(event, good);
  const V elapsed = passed(lanes, h, remaining);
  store_if(go, elapsed, lanes.elapsed[0]);
  store_if(go, hn::Add(hn::Load(d, lanes.since[0]), h), lanes.since[0]);
  for (size_t k = 0; k < 2; ++k) {
    store_if(go, to.motion.q[k], lanes.at.q[k]);
    store_if(go, to.motion.qd[k], lanes.at.qd[k]);
    store_if(go, to.qdd[k], lanes.at.qdd[k]);
  }
  const V hip = hn::MulAdd(all(model.leg), sine_cosine(to.motion.q[0]).cosine, all(model.radius));
  const Mask fallen = hn::Lt(hip, all(model.least_hip));
  const Mask ended = hn::Or(hn::Ge(elapsed, hn::Load(d, lanes.duration[0])), fallen);
  return {bits_of(hn::AndNot(sound, live)), bits_of(hn::And(good, event)),
          bits_of(hn::And(go, ended))};
}

}  // namespace
}  // namespace HWY_NAMESPACE
}  // namespace walker
}  // namespace walktrack
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace walktrack {
inline namespace walker {
namespace {
HWY_EXPORT(evaluate);
HWY_EXPORT(step_sizes);
HWY_EXPORT(step_to);
HWY_EXPORT(next_steps);
HWY_EXPORT(sub_step);
}  // namespace

void evaluate_lanes(const StraightModel& model, StraightLanes& lanes) {
  HWY_DYNAMIC_DISPATCH(evaluate)(model, lanes);
}

void lane_step_sizes(const StraightModel& model, const StraightLanes& lanes, double max_step,
                     double* sizes) {
  HWY_DYNAMIC_DISPATCH(step_sizes)(model, lanes, max_step, sizes);
}

void step_lanes_to(const StraightModel& model, const StraightLanes& lanes, const double* h,
                   StraightLanePoint& end) {
  HWY_DYNAMIC_DISPATCH(step_to)(model, lanes, h, end);
}

void next_lane_steps(const StraightLanes& lanes, double* h) {
  HWY_DYNAMIC_DISPATCH(next_steps)(lanes, h);
}

LaneVerdict sub_step_lanes(const StraightModel& model, StraightLanes& lanes) {
  return HWY_DYNAMIC_DISPATCH(sub_step)(model, lanes);
}

}  // namespace walker
}  // namespace walktrack
#endif
