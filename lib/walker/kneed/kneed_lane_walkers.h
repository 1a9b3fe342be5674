// Loads walkers into lanes, stores them, and searches a lane's first event; internal to lib/walker.
#pragma once

#include "walker/kneed/kneed_incidents.h"
#include "walker/kneed/kneed_lanes.h"

namespace walktrack {
inline namespace walker {

LaneModel lane_model(const KneedModel& model);

void load_forces(const KneedControls& controls, const Vector5& noise, size_t lane, Lanes& lanes);
// A knee at its stop moves exactly with its thigh; rounding errors are corrected.
void load_state(const KneedState& state, size_t lane, Lanes& lanes);
void store_state(const Lanes& lanes, size_t lane, KneedState& state);

// Whether the stops are consistent, as after settle_knee_stops(): a held knee is at rest and its
// stop pushes, a free one is flexed.
bool is_settled(const Lanes& lanes, size_t lane);

// Whether numbers are finite and rates below kMaxRate.
bool is_sound(const LanePoint& at, size_t lane);

// Searches the first event of one lane within a sub-step from lanes.at to `end`; guards are tested
// one after the other, in the same way as by kneed_advance().
class LaneIncident {
 public:
  LaneIncident() = default;
  LaneIncident(const Lanes& lanes, const LanePoint& end, size_t lane, double h);

  bool searching() const { return searching_; }
  // The time of the next evaluation, s since the sub-step's beginning; 0 when the search is
  // finished.
  double trial() const;
  void take(const Lanes& lanes, const LanePoint& at, const LanePoint& end);

  // When the search is finished: whether there is an event, and which.
  bool found() const { return found_; }
  const Incident& first() const { return first_; }

 private:
  void start_next(const Lanes& lanes, const LanePoint& end);
  void foot_ahead(double height, double height_rate, const LanePoint& end);
  void note(double time, IncidentKind kind);

  size_t lane_ = 0;
  double h_ = 0;
  bool pending_[4]{};  // by KneedGuard
  KneedGuard current_ = KneedGuard::kFootHeight;
  FallSearch search_;
  bool searching_ = false, found_ = false;
  Incident first_;
  double ahead_since_ = 0, height_then_ = 0;  // when the foot passed the stance foot
};

}  // namespace walker
}  // namespace walktrack
