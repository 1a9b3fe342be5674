#include "metrics/gait_error.h"

#include <cmath>
#include <numbers>

namespace walktrack {
inline namespace metrics {

namespace {

constexpr double kQuantile = 1.645;      // of the normal distribution, at 95 %
constexpr double kAcrossToWidth = 0.57;  // both feet are seen by the same camera

// Standard deviations of one contact's numbers and of a mean over steps.
struct Sizes {
  double step_length, step_width, stride_length;  // m
  double step_time, stride_time;                  // s
  double stance, double_support;                  // per cent of the stride
};
// Fitted to walks with truth by scripts/fit_gait_error.py (lib/metrics/reports/gait_of_tracks.md).
constexpr Sizes kOfContact{0.026, 0.024, 0.042, 0.037, 0.055, 1.9, 4.7};
constexpr Sizes kOfMean{0.010, 0.010, 0.013, 0.009, 0.034, 1.9, 4.4};
constexpr double kStrikeError = 0.056, kToeOffError = 0.034;  // s
constexpr double kSpeedError = 0.003;                         // m/s, of the whole way's
// From step to step: what differs from one step's error to the next looks like the walker's.
constexpr double kStepLengthNoise = 0.025;  // m
constexpr double kStepTimeNoise = 0.044;    // s

void widen(double sd, Banded& band) {
  band.p05 = band.value - std::hypot(band.value - band.p05, kQuantile * sd);
  band.p95 = band.value + std::hypot(band.p95 - band.value, kQuantile * sd);
}

// Of what cannot be negative.
void widen_positive(double sd, Banded& band) {
  widen(sd, band);
  if (band.value >= 0 && band.p05 < 0) band.p05 = 0;
}

// Relative errors of a quotient's two parts, with those of the scale.
double of_quotient(const Banded& quotient, double length_sd, const Banded& length, double time_sd,
                   const Banded& time, double scale) {
  return std::abs(quotient.value) *
         std::hypot(length_sd / length.value, time_sd / time.value, scale);
}

void widen_contact(const FigureError& figure, double weight, ContactRow& row) {
  const Sizes& s = kOfContact;
  const auto sd = [&](ContactColumn column, double size) { widen(weight * size, row.at[column]); };
  const auto of_length = [&](ContactColumn column, double size) {
    return std::hypot(size, figure.scale * row.at[column].value);
  };
  sd(kFootStrike, kStrikeError);
  sd(kToeOff, kToeOffError);
  sd(kStepLength, of_length(kStepLength, s.step_length));
  widen_positive(weight * std::hypot(s.step_width, kAcrossToWidth * figure.across),
                 row.at[kStepWidth]);
  sd(kStepTime, s.step_time);
  sd(kStrideSpeed, of_quotient(row.at[kStrideSpeed], s.stride_length, row.at[kStrideLength],
                               s.stride_time, row.at[kStrideTime], figure.scale));
  sd(kStrideLength, of_length(kStrideLength, s.stride_length));
  sd(kStrideTime, s.stride_time);
  sd(kStanceShare, s.stance);
  sd(kSwingShare, s.stance);
  sd(kDoubleSupportShare, s.double_support);
}

// `more`: how much larger the errors are than those of means over both sides.
void widen_summary(const FigureError& figure, double weight, double more, Summary& summary) {
  const Sizes& s = kOfMean;
  const auto sd = [&](SummaryColumn column, double size) {
    widen_positive(weight * size, summary[column]);
  };
  const auto of_length = [&](SummaryColumn column, double size) {
    return std::hypot(more * size, figure.scale * summary[column].value);
  };
  sd(kSpeed, of_length(kSpeed, kSpeedError));
  sd(kCadence, summary[kCadence].value * more * s.step_time / summary[kMeanStepTime].value);
  sd(kMeanStepLength, of_length(kMeanStepLength, s.step_length));
  sd(kMeanStepWidth, std::hypot(more * s.step_width, kAcrossToWidth * figure.across));
  sd(kMeanStepTime, more * s.step_time);
  sd(kMeanStrideLength, of_length(kMeanStrideLength, s.stride_length));
  sd(kMeanStrideTime, more * s.stride_time);
  sd(kMeanStance, s.stance);
  sd(kMeanSwing, s.stance);
  sd(kMeanDoubleSupport, s.double_support);
  sd(kStepLengthSd, more * kStepLengthNoise);
  sd(kStepTimeSd, more * kStepTimeNoise);
}

// 100 (left - right) / mean: both sides are wrong by sqrt(2) times the mean's error.
void widen_symmetry(double weight, const Summary& both, GaitTable& table) {
  const auto sd = [&](SymmetryColumn column, SummaryColumn of, double size) {
    widen(weight * 200 * size / both[of].value, table.symmetry[column]);
  };
  sd(kStepLengthSymmetry, kMeanStepLength, kOfMean.step_length);
  sd(kStepTimeSymmetry, kMeanStepTime, kOfMean.step_time);
  sd(kStanceSymmetry, kMeanStance, kOfMean.stance);
}

}  // namespace

void add_gait_error(const FigureError& figure, double weight, GaitTable& table) {
  for (ContactRow& row : table.contacts) widen_contact(figure, weight, row);
  widen_symmetry(weight, table.both, table);
  widen_summary(figure, weight, 1, table.both);
  widen_summary(figure, weight, std::numbers::sqrt2, table.left);
  widen_summary(figure, weight, std::numbers::sqrt2, table.right);
}

}  // namespace metrics
}  // namespace walktrack
