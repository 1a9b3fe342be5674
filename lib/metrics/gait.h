// Gait from joint centres: foot strikes, toe-offs, stances, speed and steps.
//
// A foot leaves the ground when its toe is furthest behind the pelvis along the direction of
// walking, read so that the smoothing of a track does not matter (metrics/steps/toe_off.h), and
// strikes after its ankle was furthest in front (Zeni, Richards & Higginson, Gait & Posture 27,
// 2008, with the ankle instead of the heel): from that turning point on the foot moves back with
// the pelvis until it is on the ground. This takes 3.8 % of a stride, the mean of 3.0 to 5.1 % that
// force plates measure (four strikes of two trials); heels of generated walks
// (lib/synth/walk/made_walk.h) touch the ground 2.8 % later at 0.6 m/s, 3.8 % at 1.8. The
// deceleration of the foot would be a more direct sign, but a tracked foot lands more slowly than
// the person's (README.md). Rows in which the pelvis moves by less than 15 cm per second are
// standing: they belong to no walk, neither to its events nor to its speed. Turning points count if
// the foot has swung by at least kLeastSwing, so that a person who stands or sways has no gait.
// Times are interpolated between rows. Metres, seconds; the ground is z = 0.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "body/motion.h"

namespace walktrack {
inline namespace metrics {

inline constexpr double kLeastSwing = 0.12;  // m; a third of the steps of a shuffling gait, 0.4 m

enum class GaitEventKind { kFootStrike, kToeOff };

struct GaitEvent {
  double time;
  Side side;
  GaitEventKind kind;
};

// One foot on the ground. A stance cut by an end of the motion has no event there.
struct Stance {
  Side side;
  double on, off;                         // s
  bool starts_in_motion, ends_in_motion;  // whether on and off are events, not ends of the motion
  Eigen::Vector2d place;                  // mean of (ankle + toe) / 2 over the middle of the stance
};

// Whether the second stance is the next step after the first: that of the other foot, both of whose
// strikes are in the motion.
bool is_step(const Stance& from, const Stance& to);

// The next stance of the same foot; nullptr if its strike is not in the motion, or is of another
// walk.
const Stance* next_of_side(const std::vector<Stance>& stances, size_t from);
// The same, with whose strike the stride ends; nullptr also if the first strike is not in the
// motion.
const Stance* stride_end(const std::vector<Stance>& stances, size_t from);

// From a stance to the next one of the other foot; indices of Gait::stances. Steps exist only
// between strikes that are both in the motion: the position of a foot whose stance is cut by the
// beginning of the motion is not accurate enough.
struct Step {
  size_t from, to;
  double length, width;  // m, along and across the direction of walking
  double time;           // s, between the strikes
};

struct Gait {
  std::vector<GaitEvent> events;  // by time
  std::vector<Stance> stances;    // by time of `on`, then `off`
  double speed = 0;  // m/s, length of the pelvis' smoothed path over its duration while walking
  size_t walks = 0;  // parts of the motion in which the subject walks
  double way = 0;    // m, length of that path in all of them
  std::vector<Step> steps;
  double stride_time = 0;       // s, twice the mean step time; 1.1 without steps
  double mean_step_length = 0;  // m, along the direction of walking; 0 without steps
  double mean_step_time = 0;    // s, between their strikes; 0 without
  double mean_step_width = 0;   // m, across the direction of walking
  double stance_share = 0;      // of the stride, over complete strides; 0 without
};

Gait gait_from_motion(const Motion& motion);

// The part of a stance in which the sole is flat: 16 % to 59 % of it. By hand.
inline constexpr double kFlatFrom = 0.16, kFlatTo = 0.59;

// The middle of the foot, (ankle + toe) / 2.
inline Eigen::Vector3d foot_point(const JointPositions& joints, Side side) {
  return 0.5 * (joints[ankle(side)] + joints[toe(side)]);
}

// Differences between the events of two gaits of one walk, matched by side and kind to the nearest
// one within a quarter of a second.
struct EventErrors {
  size_t matched = 0, missed = 0, extra = 0;
  double mean_late = 0;      // s, estimate minus truth
  double mean_absolute = 0;  // s
};

EventErrors event_errors(const std::vector<GaitEvent>& truth,
                         const std::vector<GaitEvent>& estimate);

}  // namespace metrics
}  // namespace walktrack
