#include "metrics/gait_error.h"

#include <cmath>
#include <numbers>

#include "core/conventions.h"

namespace walktrack {
inline namespace metrics {

namespace {

// Standard deviations, fitted by scripts/fit_gait_error.py (lib/tracker/reports/bands.md).
constexpr double kStrikeError = 0.002, kToeOffError = 0.006;  // s
constexpr double kClearanceError = 0.010;                     // m
constexpr double kProgressionError = 0.21;                    // rad
// Of the figure's error.
constexpr double kAcrossToWidth = 0.9, kAcrossToStrike = 0.7, kAcrossToBase = 0.8;
constexpr double kStepLengthNoise = 0.02;  // m
constexpr double kStepTimeNoise = 0.016;   // s

// Of times that end with an event of each kind and begin with one, per cent of a stride.
double stance_error(double stride_time) {
  return 100 * std::hypot(kStrikeError, kToeOffError) / stride_time;
}

void widen(double sd, Banded& band) {
  band.p05 = band.value - std::hypot(band.value - band.p05, kBandQuantile * sd);
  band.p95 = band.value + std::hypot(band.p95 - band.value, kBandQuantile * sd);
}

// Of what cannot be negative.
void widen_positive(double sd, Banded& band) {
  widen(sd, band);
  if (band.value >= 0 && band.p05 < 0) band.p05 = 0;
}

void widen_shares(double weight, double stride_time, Banded& stance, Banded& swing,
                  Banded& double_support) {
  const double sd = weight * stance_error(stride_time);
  widen(sd, stance);
  widen(sd, swing);
  widen_positive(2 * sd, double_support);
}

void widen_contact(const FigureError& figure, double weight, ContactRow& row) {
  widen(weight * kStrikeError, row.at[kFootStrike]);
  widen(weight * kToeOffError, row.at[kToeOff]);
  widen_positive(weight * kAcrossToWidth * figure.across, row.at[kStepWidth]);
  widen(weight * kAcrossToStrike * figure.across, row.at[kWidthAtStrike]);
  widen(weight * kAcrossToBase * figure.across, row.at[kWalkingBase]);
  widen(weight * kClearanceError, row.at[kToeClearance]);
  widen(weight * deg_from_rad(kProgressionError), row.at[kFootProgression]);
  widen_shares(weight, row.at[kStrideTime].value, row.at[kStanceShare], row.at[kSwingShare],
               row.at[kDoubleSupportShare]);
}

void widen_summary(const FigureError& figure, double weight, Summary& summary) {
  widen_positive(weight * kAcrossToWidth * figure.across, summary[kMeanStepWidth]);
  widen(weight * kAcrossToStrike * figure.across, summary[kMeanWidthAtStrike]);
  widen(weight * kAcrossToBase * figure.across, summary[kMeanWalkingBase]);
  widen(weight * kClearanceError, summary[kMeanToeClearance]);
  widen(weight * deg_from_rad(kProgressionError), summary[kMeanFootProgression]);
  widen_shares(weight, summary[kMeanStrideTime].value, summary[kMeanStance], summary[kMeanSwing],
               summary[kMeanDoubleSupport]);
  widen_positive(weight * kStepLengthNoise, summary[kStepLengthSd]);
  widen_positive(weight * kStepTimeNoise, summary[kStepTimeSd]);
}

}  // namespace

void add_gait_error(const FigureError& figure, double weight, GaitTable& table) {
  for (ContactRow& row : table.contacts) widen_contact(figure, weight, row);
  // 100 (left - right) / mean: both sides have the mean's error.
  const Summary& both = table.both;
  widen(weight * 100 * std::numbers::sqrt2 * stance_error(both[kMeanStrideTime].value) /
            both[kMeanStance].value,
        table.symmetry[kStanceSymmetry]);
  for (Summary* summary : {&table.both, &table.left, &table.right})
    widen_summary(figure, weight, *summary);
}

}  // namespace metrics
}  // namespace walktrack
