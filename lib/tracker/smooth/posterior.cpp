#include "tracker/smooth/posterior.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <utility>

#include "body/kinematics.h"
#include "core/conventions.h"
#include "tracker/moves/mirror_legs.h"

namespace walktrack {
inline namespace tracker {

namespace {

// Bands are from 5 to 95 %.
constexpr double kTail = 0.05;
// Below this probability swapped legs do not change a band.
constexpr double kNeverSwapped = 1e-3;
// Stated probabilities of 5 to 50 % that the legs are swapped came true in 3 % of the frames of 63
// rendered videos, where 10 % were stated (tracker/reports/bands.md): a third of the odds.
constexpr double kSwappedOdds = 1.0 / 3;

double calibrated(double p_swapped) {
  const double odds = kSwappedOdds * p_swapped;
  return odds / (odds + 1 - p_swapped);
}

Spread normal_spread(double mean, double sd) {
  return {mean, sd, mean - kBandQuantile * sd, mean + kBandQuantile * sd};
}

// Sums of the squared differences of draws from what is reported.
struct Squares {
  std::array<Eigen::Vector3d, kJointCount> joints;
  JointAngles angles{};

  Squares() { joints.fill(Eigen::Vector3d::Zero()); }
  void add(const JointPositions& reported, const JointPositions& drawn) {
    for (size_t j = 0; j < kJointCount; ++j)
      joints[j] += (drawn.at[j] - reported.at[j]).cwiseAbs2();
  }
  void add(const JointAngles& reported, const JointAngles& drawn) {
    for (size_t k = 0; k < kJointAngleCount; ++k)
      angles[k] += std::pow(std::remainder(drawn[k] - reported[k], 2 * kPi), 2);
  }
  // The normal distributions about the joints and the pose of `estimate`.
  void spread(size_t draws, FrameEstimate& estimate) const {
    const double count = static_cast<double>(draws);
    for (size_t j = 0; j < estimate.joint_count; ++j)
      for (Eigen::Index axis = 0; axis < 3; ++axis)
        estimate.spread[j][static_cast<size_t>(axis)] =
            normal_spread(estimate.joints.at[j][axis], std::sqrt(joints[j][axis] / count));
    const JointAngles middle = joint_angles(estimate.pose);
    for (size_t k = 0; k < kJointAngleCount; ++k)
      estimate.angles[k] = normal_spread(middle[k], std::sqrt(angles[k] / count));
  }
};

double cumulative(const Normal& normal, double x) {
  if (normal.sd == 0) return x < normal.mean ? 0 : 1;
  return 0.5 * std::erfc((normal.mean - x) / (normal.sd * std::numbers::sqrt2));
}

// The mean stays that of this leg: it is what is reported.
Spread mixed(const Spread& own, const Spread& other, double share) {
  const Normal one{own.mean, own.sd}, two{other.mean, other.sd};
  const double apart = other.mean - own.mean;
  return {own.mean,
          std::sqrt((1 - share) * own.sd * own.sd +
                    share * (other.sd * other.sd + (1 - share) * apart * apart)),
          mixture_quantile(one, two, share, kTail), mixture_quantile(one, two, share, 1 - kTail)};
}

// Every number with that of the same figure whose legs are swapped.
void mix_legs(const Body& body, double share, FrameRecord& record) {
  FrameRecord swapped = record;
  mirror_legs(body, swapped);
  FrameEstimate& estimate = record.estimate;
  for (size_t j = 0; j < estimate.joint_count; ++j)
    for (size_t axis = 0; axis < 3; ++axis)
      estimate.spread[j][axis] =
          mixed(estimate.spread[j][axis], swapped.estimate.spread[j][axis], share);
  for (size_t k = 0; k < kJointAngleCount; ++k)
    estimate.angles[k] = mixed(estimate.angles[k], swapped.estimate.angles[k], share);
}

}  // namespace

double mixture_quantile(const Normal& one, const Normal& other, double share, double quantile) {
  constexpr double kFar = 10;  // standard deviations
  constexpr int kHalvings = 60;
  double low = std::min(one.mean - kFar * one.sd, other.mean - kFar * other.sd);
  double high = std::max(one.mean + kFar * one.sd, other.mean + kFar * other.sd);
  for (int i = 0; i < kHalvings; ++i) {
    const double middle = 0.5 * (low + high);
    const double below = (1 - share) * cumulative(one, middle) + share * cumulative(other, middle);
    (below < quantile ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

Posterior::Posterior(const BodyModel& model, BandScene scene, size_t samples)
    : model_(model), scene_(std::move(scene)) {
  for (size_t i = 0; i < samples; ++i) errors_.emplace_back(scene_.seed, static_cast<uint32_t>(i));
}

void Posterior::report(const Pose& pose, std::span<const Pose> draws, double velocity, double dt,
                       FrameRecord& record) {
  FrameEstimate& estimate = record.estimate;
  estimate.pose = pose;
  estimate.speed = velocity;
  const JointPositions joints = forward_kinematics(model_.body, pose).joints;
  for (size_t j = 0; j < estimate.joint_count; ++j) estimate.joints.at[j] = joints.at[j];
  Squares squares;
  std::vector<JointPositions> drawn;
  for (const Pose& draw : draws) {
    drawn.push_back(forward_kinematics(model_.body, draw).joints);
    squares.add(joints, drawn.back());
    squares.add(joint_angles(pose), joint_angles(draw));
  }
  squares.spread(draws.size(), estimate);
  add_model_error(scene_.cameras, scene_.model_error, estimate);
  const double swapped = calibrated(record.modes.p_legs_swapped);
  report_samples(drawn, swapped, dt, record);
  if (swapped > kNeverSwapped) mix_legs(model_.body, swapped, record);
}

void Posterior::report_samples(std::span<const JointPositions> draws, double swapped, double dt,
                               FrameRecord& record) {
  const Eigen::Matrix3d figure = figure_root(scene_.cameras, record.estimate.joints);
  for (size_t i = 0; i < record.samples.size(); ++i) {
    JointPositions& sample = record.samples[i];
    sample = draws[i];
    const JointPositions error = errors_[i].next(dt, figure);
    for (size_t j = 0; j < record.estimate.joint_count; ++j)
      sample.at[j] += scene_.model_error * error.at[j];
    if (errors_[i].share() < swapped) swap_legs(sample);
  }
}

}  // namespace tracker
}  // namespace walktrack
