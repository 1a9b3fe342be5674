#include "observation/keypoints/keypoint_errors.h"

#include <algorithm>
#include <cmath>

#include <Eigen/LU>

namespace walktrack {
inline namespace observation {

namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

// By kind; those of toes and heels are from COCO-WholeBody (Jin et al., ECCV 2020).
constexpr std::array<double, kPointKinds> kFirstScale{.015, .033, .030, .026, .045,
                                                      .037, .037, .028, .028};
// A track that is lost makes every residual large: scales may grow by this factor at most, and
// shrink to those of the best detectors. By hand.
constexpr double kMostGrowth = 1.5, kSmallestShare = 0.2;
// Steps of the running median of a scale's logarithm. By hand.
constexpr double kFirstStep = 0.2, kLastStep = 0.005;
// Number of frames after which the weight of an offset's evidence has decayed to 1/e: 10 to 20 s.
// By hand.
constexpr double kMemory = 600;
// People and detectors place a joint about 2 cm apart, a hip more; shares of the height. This prior
// limits how far an offset can explain an error of the body's position.
constexpr double kOffsetSd = 0.008, kHipOffsetSd = 0.016;

double offset_sd(size_t kind) {
  return static_cast<PointKind>(kind) == PointKind::kHip ? kHipOffsetSd : kOffsetSd;
}

// The inverse of the offset's covariance.
Matrix2d precision_of(const KeypointErrors& errors, size_t kind) {
  const auto& [xx, xy, yy] = errors.information[kind];
  const double prior = 1 / (offset_sd(kind) * offset_sd(kind));
  Matrix2d precision;
  precision << xx + prior, xy, xy, yy + prior;
  return precision;
}

Vector2d mean_offset(const KeypointErrors& errors, size_t kind) {
  const auto& [x, y] = errors.pull[kind];
  return precision_of(errors, kind).inverse() * Vector2d(x, y);
}

void learn_scale(size_t kind, double z, double dof, KeypointErrors& errors) {
  // The median length of a residual with two Student-t coordinates, in scales.
  const double median = std::sqrt(dof * (std::pow(2, 2 / dof) - 1));
  const auto seen = static_cast<double>(++errors.seen[kind]);
  const double step = std::max(kLastStep, kFirstStep / std::sqrt(seen));
  double& scale = errors.scale[kind];
  scale *= std::exp(z > median ? step : -step);
  scale = std::clamp(scale, kSmallestShare * kFirstScale[kind], kMostGrowth * kFirstScale[kind]);
}

}  // namespace

KeypointErrors initial_errors() {
  KeypointErrors out;
  out.scale = kFirstScale;
  return out;
}

PointOffset offset_of(const KeypointErrors& errors, PointKind kind) {
  const auto k = static_cast<size_t>(kind);
  return {mean_offset(errors, k), precision_of(errors, k).inverse().diagonal().cwiseSqrt()};
}

PointOffsets offsets_of(const KeypointErrors& errors) {
  PointOffsets out;
  for (size_t kind = 0; kind < kPointKinds; ++kind) out[kind] = mean_offset(errors, kind);
  return out;
}

void learn(const PointResidual& residual, double dof, double temper, KeypointErrors& errors) {
  const auto kind = static_cast<size_t>(kind_of(residual.point));
  const double z = residual.px.norm() / residual.scale_px;
  const double weight = temper * (dof + 2) / (dof + z * z) / std::pow(residual.scale_px, 2);
  const Matrix2d& j = residual.px_per_offset;
  const Matrix2d more = weight * j.transpose() * j;
  const Vector2d pull = weight * j.transpose() * (residual.px + j * mean_offset(errors, kind));
  auto& information = errors.information[kind];
  information = {information[0] + more(0, 0), information[1] + more(0, 1),
                 information[2] + more(1, 1)};
  errors.pull[kind] = {errors.pull[kind][0] + pull.x(), errors.pull[kind][1] + pull.y()};
  learn_scale(kind, z, dof, errors);
}

void forget(KeypointErrors& errors) {
  constexpr double kKept = 1 - 1 / kMemory;
  for (size_t kind = 0; kind < kPointKinds; ++kind) {
    for (double& each : errors.information[kind]) each *= kKept;
    for (double& each : errors.pull[kind]) each *= kKept;
  }
}

}  // namespace observation
}  // namespace walktrack
