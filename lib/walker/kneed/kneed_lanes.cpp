// The kernels of kneed_lanes.h for every instruction set; the best one of the machine is chosen at
// run time.
#include "walker/kneed/kneed_lanes.h"

#include "walker/kneed/kneed_incidents.h"
#include "walker/lanes/lane_targets.h"

#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "walker/kneed/kneed_lanes.cpp"
#include <hwy/foreach_target.h>
// After foreach_target.h, as Highway requires.
#include "walker/kneed/kneed_lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace walktrack {
inline namespace walker {
namespace HWY_NAMESPACE {
namespace {

HWY_INLINE Motion motion_at(const LanePoint& at) {
  Motion motion;
  load(at.q, motion.q);
  load(at.qd, motion.qd);
  return motion;
}

HWY_INLINE Setting setting(const LaneModel& model, const Lanes& lanes) {
  const Tag d;
  const V none = hn::Zero(d);
  return {model,
          lanes.forces,
          {hn::Ne(hn::Load(d, lanes.held[0]), none), hn::Ne(hn::Load(d, lanes.held[1]), none)}};
}

HWY_INLINE void store_point(const Motion& motion, const V (&qdd)[5], const Surroundings& around,
                            LanePoint& at) {
  const Tag d;
  store(motion.q, at.q);
  store(motion.qd, at.qd);
  store(qdd, at.qdd);
  store(around.stop_torque, at.stop_torque);
  hn::Store(around.height, d, at.height[0]);
  hn::Store(around.lead, d, at.lead[0]);
  hn::Store(around.height_rate, d, at.height_rate[0]);
  hn::Store(around.hip, d, at.hip[0]);
}

void evaluate(const LaneModel& model, Lanes& lanes) {
  const Motion motion = motion_at(lanes.at);
  V qdd[5];
  Surroundings around;
  accelerations(setting(model, lanes), motion, qdd, &around);
  store_point(motion, qdd, around, lanes.at);
}

void step_sizes_of(const LaneModel& model, const Lanes& lanes, double max_step, double* sizes) {
  hn::Store(step_sizes(model, lanes.forces, motion_at(lanes.at), max_step), Tag(), sizes);
}

void next_steps(const Lanes& lanes, double* h) {
  V remaining;
  hn::Store(next_step(lanes, remaining), Tag(), h);
}

struct Arrival {
  Motion motion;
  V qdd[5];
  Surroundings around;
};

HWY_INLINE Mask is_sound(const Arrival& to) {
  V sum = hn::Zero(Tag());
  Mask slow = hn::Lt(hn::Abs(to.motion.qd[0]), all(kMaxRate));
  for (int k = 0; k < 5; ++k) {
    sum = hn::Add(sum, hn::Add(hn::Abs(to.motion.q[k]), hn::Abs(to.qdd[k])));
    slow = hn::And(slow, hn::Lt(hn::Abs(to.motion.qd[k]), all(kMaxRate)));
  }
  return hn::And(slow, hn::Lt(sum, all(1e300)));  // false for NaN
}

// A superset of the events: the foot below the ground at either end and in front at the second, a
// knee beyond its stop, a stop that pulls.
HWY_INLINE Mask suspects_event(const Setting& at, const LanePoint& from, const Arrival& to) {
  const V none = hn::Zero(Tag()), height = hn::Load(Tag(), from.height[0]);
  Mask event =
      hn::And(hn::Gt(to.around.lead, none), hn::Le(hn::Min(height, to.around.height), none));
  for (int knee = 0; knee < 2; ++knee) {
    const V guard =
        hn::IfThenElse(at.held[knee], to.around.stop_torque[knee], to.motion.q[3 + knee]);
    event = hn::Or(event, hn::Lt(guard, all(-kGuardTolerance)));
  }
  return event;
}

// KneedState::clearance: between falling and rising the height is approximated by a parabola.
HWY_INLINE V clearance_after(const Lanes& lanes, V h, V rise) {
  const Tag d;
  const V none = hn::Zero(d), clearance = hn::Load(d, lanes.clearance[0]);
  const V fall = hn::Load(d, lanes.at.height_rate[0]);
  const V drop = hn::Div(hn::Mul(hn::Mul(fall, fall), h), hn::Sub(rise, fall));
  const V least = hn::NegMulAdd(drop, all(0.5), hn::Load(d, lanes.at.height[0]));
  const Mask lowest = hn::And(hn::Lt(fall, none), hn::Gt(rise, none));
  return hn::IfThenElse(lowest, hn::Min(clearance, least), clearance);
}

HWY_INLINE void arrive_if(Mask go, const Arrival& to, LanePoint& at) {
  for (size_t k = 0; k < 5; ++k) {
    store_if(go, to.motion.q[k], at.q[k]);
    store_if(go, to.motion.qd[k], at.qd[k]);
    store_if(go, to.qdd[k], at.qdd[k]);
  }
  for (size_t knee = 0; knee < 2; ++knee)
    store_if(go, to.around.stop_torque[knee], at.stop_torque[knee]);
  store_if(go, to.around.height, at.height[0]);
  store_if(go, to.around.lead, at.lead[0]);
  store_if(go, to.around.height_rate, at.height_rate[0]);
  store_if(go, to.around.hip, at.hip[0]);
}

HWY_INLINE void arrive(const LaneModel& model, const Lanes& lanes, V h, Arrival& to) {
  const Setting at = setting(model, lanes);
  V qdd[5];
  load(lanes.at.qdd, qdd);
  rk4(at, motion_at(lanes.at), qdd, h, to.motion);
  accelerations(at, to.motion, to.qdd, &to.around);
}

void step_to(const LaneModel& model, const Lanes& lanes, const double* h, LanePoint& end) {
  Arrival to;
  arrive(model, lanes, hn::Load(Tag(), h), to);
  store_point(to.motion, to.qdd, to.around, end);
}

LaneVerdict sub_step(const LaneModel& model, const LaneBounds& bounds, Lanes& lanes) {
  const Tag d;
  V remaining;
  const V h = next_step(lanes, remaining);
  Arrival to;
  arrive(model, lanes, h, to);
  const Mask live = hn::Ne(hn::Load(d, lanes.live[0]), hn::Zero(d)), sound = is_sound(to);
  const Mask event = suspects_event(setting(model, lanes), lanes.at, to);
  const Mask good = hn::And(live, sound), go = hn::AndNot(event, good);

  const V elapsed = passed(lanes, h, remaining);
  store_if(go, elapsed, lanes.elapsed[0]);
  store_if(go, hn::Add(hn::Load(d, lanes.since[0]), h), lanes.since[0]);
  store_if(go, clearance_after(lanes, h, to.around.height_rate), lanes.clearance[0]);
  arrive_if(go, to, lanes.at);

  const Mask fallen = hn::Or(hn::Lt(to.around.hip, all(bounds.least_hip)),
                             hn::Gt(hn::Abs(to.motion.q[0]), all(bounds.max_lean)));
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
HWY_EXPORT(step_to);
HWY_EXPORT(step_sizes_of);
HWY_EXPORT(next_steps);
HWY_EXPORT(sub_step);
}  // namespace

void evaluate_lanes(const LaneModel& model, Lanes& lanes) {
  HWY_DYNAMIC_DISPATCH(evaluate)(model, lanes);
}

void lane_step_sizes(const LaneModel& model, const Lanes& lanes, double max_step, double* sizes) {
  HWY_DYNAMIC_DISPATCH(step_sizes_of)(model, lanes, max_step, sizes);
}

void step_lanes_to(const LaneModel& model, const Lanes& lanes, const double* h, LanePoint& end) {
  HWY_DYNAMIC_DISPATCH(step_to)(model, lanes, h, end);
}

void next_lane_steps(const Lanes& lanes, double* h) { HWY_DYNAMIC_DISPATCH(next_steps)(lanes, h); }

LaneVerdict sub_step_lanes(const LaneModel& model, const LaneBounds& bounds, Lanes& lanes) {
  return HWY_DYNAMIC_DISPATCH(sub_step)(model, bounds, lanes);
}

}  // namespace walker
}  // namespace walktrack
#endif
