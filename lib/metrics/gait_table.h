// Gait as tables: one row for each contact of a foot with the ground, and one summary of the walk,
// every number with a 5-95 % band.
//
// Events are those of metrics/gait.h. A contact's row holds its own strike and toe-off, the step
// that ended in it (from the other foot's contact before) and the stride that began with it (to the
// next strike of the same foot). If an end of the motion cuts a contact, the numbers that cannot be
// computed are NaN.
//
// Bands come from an ensemble of motions that are as likely for the tracker (samples of its
// posterior distribution). The same numbers are computed for each of them. The band of a contact
// contains the value and the 5 and 95 % quantiles of the members that have the same contact; the
// band of a summary comes from the differences between the members and the motion over the contacts
// that both have. It is NaN if fewer than half of the members, or fewer than five, have the number.
// metrics/gait_error.h adds the errors that all members share.
//
// Numbers that need more steps are NaN, too: a symmetry needs two contacts of each side, a spread
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
  kSupportTransfer,  // when this foot became the stance foot in the model, to check the strike
  kStepLength,       // along the direction of walking
  kStepWidth,        // across it
  kStepTime,         // strike to strike
  kStrideLength,
  kStrideTime,
  kStrideSpeed,
  kStanceShare,
  kSwingShare,
  kDoubleSupportShare,  // before and after single support together
  kToeClearance,  // of the swing after this contact; this and the next four: steps/foot_placement.h
  kFootProgression,
  kWidthAtStrike,
  kWalkingBase,
  kTurn,
  kContactColumnCount
};
inline constexpr std::array<std::string_view, kContactColumnCount> kContactColumns{
    "foot_strike_s",
    "toe_off_s",
    "support_transfer_s",
    "step_length_m",
    "step_width_m",
    "step_time_s",
    "stride_length_m",
    "stride_time_s",
    "speed_m_s",
    "stance_percent",
    "swing_percent",
    "double_support_percent",
    "toe_clearance_m",
    "foot_progression_deg",
    "width_at_strike_m",
    "walking_base_m",
    "turn_deg"};

struct ContactRow {
  Side side = Side::kLeft;
  std::array<Banded, kContactColumnCount> at;
};

// The numbers of a summary: means over contacts, except for the speed, which is that of the whole
// walk.
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
  kMeanToeClearance,
  kMeanFootProgression,
  kMeanWidthAtStrike,
  kMeanWalkingBase,
  kSummaryColumnCount
};
inline constexpr std::array<std::string_view, kSummaryColumnCount> kSummaryColumns{
    "speed_m_s",       "cadence_steps_per_min",  "step_length_m",     "step_width_m",
    "step_time_s",     "stride_length_m",        "stride_time_s",     "stance_percent",
    "swing_percent",   "double_support_percent", "step_length_sd_m",  "step_time_sd_s",
    "toe_clearance_m", "foot_progression_deg",   "width_at_strike_m", "walking_base_m"};
using Summary = std::array<Banded, kSummaryColumnCount>;

// 100 (left - right) / mean of both, per cent: 0 is symmetric.
enum SymmetryColumn { kStepLengthSymmetry, kStepTimeSymmetry, kStanceSymmetry, kSymmetryCount };
inline constexpr std::array<std::string_view, kSymmetryCount> kSymmetryColumns{
    "step_length_percent", "step_time_percent", "stance_percent"};

struct GaitTable {
  std::vector<ContactRow> contacts;  // by time
  size_t steps = 0, strides = 0;     // those with a length
  size_t turning_steps = 0;          // contacts whose turn is more than kTurningStep_deg
  Summary both, left, right;         // left: steps that end with the left foot
  std::array<Banded, kSymmetryCount> symmetry;
};

// When a foot became the stance foot in a model.
struct SupportTransfer {
  Side side = Side::kLeft;
  Banded time;
};

GaitTable gait_table(const Motion& motion, const Ensemble& members,
                     std::span<const SupportTransfer> transfers);

}  // namespace metrics
}  // namespace walktrack
