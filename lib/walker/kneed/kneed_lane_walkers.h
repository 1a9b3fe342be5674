// Walkers in and out of lanes, and the search for a lane's first event; internal to lib/walker.
#pragma once

#include "walker/kneed/kneed_incidents.h"
#include "walker/kneed/kneed_lanes.h"

namespace walktrack {
inline namespace walker {

LaneModel lane_model(const KneedModel& model);

void load_forces(const KneedControls& controls, const Vector5& noise, size_t lane, Lanes& lanes);
// A knee at its stop moves with its thigh exactly: what rounding left is put right.
void load_state(const KneedState& state, size_t lane, Lanes& lanes);
void store_state(const Lanes& lanes, size_t lane, KneedState& state);

// Whether the stops are as settle_knee_stops() would leave them: a held knee rests and its stop
// pushes, a free one is bent.
bool is_settled(const Lanes& lanes, size_t lane);

// Whether numbers are finite and rates below kMaxRate.
bool is_sound(const LanePoint& at, size_t lane);

// The search for the first event of one lane within a sub-step from lanes.at to `end`; its guards
// are looked at one after the other, as kneed_advance() does.
class LaneIncident {
 public:
  LaneIncident() = default;
  LaneIncident(const Lanes& lanes, const LanePoint& end, size_t lane, double h);

  bool searching() const { return searching_; }
  // Where the walker is wanted next, s since the sub-step's begin; 0 when the search is over.
  double trial() const;
  void take(const Lanes& lanes, const LanePoint& at, const LanePoint& end);

  // When the search is over: whether anything happens, and what.
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
