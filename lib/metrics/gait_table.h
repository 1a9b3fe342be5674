// Gait as tables: one row for each contact of a foot with the ground, and one summary of the walk,
// every number with a 5-95 % band.
//
// Events are those of metrics/gait.h. A contact's row holds its own strike and toe-off, the step
// that ended in it (from the other foot's contact before) and the stride that began with it (to the
// next strike of the same foot). Where an end of the motion cuts a contact, what it would need is
// NaN.
//
// Bands come from an ensemble: motions that the tracker holds for possible as well (a few particles
// of every frame). Each is read like the motion itself. A contact's band holds the value and lies
// between the 5 and 95 % points of the members that saw the same contact; a summary's, of how much
// the members differ from the motion over the contacts that both have. NaN if fewer than half of
// the members, or fewer than five, know. It says how far the tracker is from certain, not how far
// its model is from the person; metrics/gait_error.h adds that.
//
// What few steps cannot tell is NaN too: a symmetry needs two contacts of either side, a spread
// from step to step needs three steps.
//
// Seconds, metres; shares of the stride in per cent; the ground is z = 0.
#pragma once

#include <array>
#include <limits>
#include <span>
#include <string_view>
#include <vector>

#include "metrics/gait.h"

namespace walktrack {
inline namespace metrics {

struct Banded {
  double value = std::numeric_limits<double>::quiet_NaN();
  double p05 = value, p95 = value;
};

// The columns of a contact's row, in the order of kContactColumns.
enum ContactColumn {
  kFootStrike,
  kToeOff,
  kSupportTransfer,  // when the model's weight changed onto this foot: the check on the strike
  kStepLength,       // along the direction of walking
  kStepWidth,        // across it
  kStepTime,         // strike to strike
  kStrideLength,
  kStrideTime,
  kStrideSpeed,
  kStanceShare,
  kSwingShare,
  kDoubleSupportShare,  // both ends of the stance together
  kContactColumnCount
};
inline constexpr std::array<std::string_view, kContactColumnCount> kContactColumns{
    "foot_strike_s", "toe_off_s",      "support_transfer_s", "step_length_m",
    "step_width_m",  "step_time_s",    "stride_length_m",    "stride_time_s",
    "speed_m_s",     "stance_percent", "swing_percent",      "double_support_percent"};

struct ContactRow {
  Side side = Side::kLeft;
  std::array<Banded, kContactColumnCount> at;
};

// The numbers of a summary: means over contacts, but the speed of the whole way.
enum SummaryColumn {
  kSpeed,
  kCadence,  // 60 / mean step time
  kMeanStepLength,
  kMeanStepWidth,
  kMeanStepTime,
  kMeanStrideLength,
  kMeanStrideTime,
  kMeanStance,
  kMeanSwing,
  kMeanDoubleSupport,
  kStepLengthSd,  // from step to step
  kStepTimeSd,
  kSummaryColumnCount
};
inline constexpr std::array<std::string_view, kSummaryColumnCount> kSummaryColumns{
    "speed_m_s",     "cadence_steps_per_min",  "step_length_m",    "step_width_m",
    "step_time_s",   "stride_length_m",        "stride_time_s",    "stance_percent",
    "swing_percent", "double_support_percent", "step_length_sd_m", "step_time_sd_s"};
using Summary = std::array<Banded, kSummaryColumnCount>;

// 100 (left - right) / mean of both, per cent: 0 is symmetric.
enum SymmetryColumn { kStepLengthSymmetry, kStepTimeSymmetry, kStanceSymmetry, kSymmetryCount };
inline constexpr std::array<std::string_view, kSymmetryCount> kSymmetryColumns{
    "step_length_percent", "step_time_percent", "stance_percent"};

struct GaitTable {
  std::vector<ContactRow> contacts;  // by time
  size_t steps = 0, strides = 0;     // that have a length
  Summary both, left, right;         // left: steps that end with the left foot
  std::array<Banded, kSymmetryCount> symmetry;
};

// When a model's weight changed onto a foot.
struct SupportTransfer {
  Side side = Side::kLeft;
  Banded time;
};

GaitTable gait_table(const Motion& motion, const Ensemble& members,
                     std::span<const SupportTransfer> transfers);

}  // namespace metrics
}  // namespace walktrack
