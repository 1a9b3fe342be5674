#include "tracker/smooth/estimate.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "body/kinematics.h"
#include "body/pose_numbers.h"
#include "core/conventions.h"
#include "core/parallel_for.h"
#include "core/scratch.h"

namespace walktrack {
inline namespace tracker {

namespace {

// Columns of up to a thousand particles stay on the stack.
using ColumnScratch = Scratch<16 * 1024>;

// Adds `weight` times a pose's numbers; headings as differences to the first particle's, so that a
// full turn does not split them.
void add_pose(const Pose& pose, double weight, double reference_heading, Pose& sum) {
  for (const PoseNumber& number : kPoseNumbers)
    number.in(sum) +=
        weight * number.difference(number.turns ? reference_heading : 0, number.in(pose));
}

// Angles as differences to those of the mean pose, so that a full turn does not split them.
void spread_angles(std::span<const WalkerParticle> particles, std::span<const double> weights,
                   int threads, FrameEstimate& out) {
  const JointAngles middle = joint_angles(out.pose);
  std::vector<JointAngles> all(particles.size());
  parallel_for(particles.size(), threads, [&](size_t i) {
    all[i] = joint_angles(particles[i].pose);
    for (size_t k = 0; k < kJointAngleCount; ++k)
      all[i][k] = middle[k] + std::remainder(all[i][k] - middle[k], 2 * kPi);
  });
  parallel_for(kJointAngleCount, threads, [&](size_t k) {
    ColumnScratch scratch;
    std::pmr::vector<double> values(all.size(), scratch.memory());
    for (size_t i = 0; i < all.size(); ++i) values[i] = all[i][k];
    out.angles[k] = weighted_spread(values, weights);
  });
}

// Walkers run by their own clocks: the pace turns the walker's time into the person's.
double since_transfer(const WalkerParticle& particle) {
  return particle.walker.since_transfer / std::exp(particle.residual_before[kPace]);
}

// Over the particles that stand on `side`, one at least.
Spread since_transfer(std::span<const WalkerParticle> particles, std::span<const double> weights,
                      Side side) {
  ColumnScratch scratch;
  std::pmr::vector<double> values(scratch.memory()), shares(scratch.memory());
  values.reserve(particles.size());
  shares.reserve(particles.size());
  double total = 0;
  for (size_t i = 0; i < particles.size(); ++i) {
    if (particles[i].stance != side || weights[i] == 0) continue;
    values.push_back(since_transfer(particles[i]));
    shares.push_back(weights[i]);
    total += weights[i];
  }
  for (double& share : shares) share /= total;
  return weighted_spread(values, shares);
}

void shift(double by, Spread& spread) {
  spread.mean += by;
  spread.p05 += by;
  spread.p95 += by;
}

}  // namespace

void shift_bands(const FrameEstimate& from, FrameEstimate& to) {
  for (size_t j = 0; j < to.joint_count; ++j) {
    const Eigen::Vector3d by = to.joints.at[j] - from.joints.at[j];
    for (size_t axis = 0; axis < 3; ++axis)
      shift(by[static_cast<Eigen::Index>(axis)], to.spread[j][axis]);
  }
  const JointAngles before = joint_angles(from.pose), now = joint_angles(to.pose);
  for (size_t k = 0; k < kJointAngleCount; ++k)
    shift(std::remainder(now[k] - before[k], 2 * kPi), to.angles[k]);
}

Spread weighted_spread(std::span<const double> values, std::span<const double> weights) {
  ColumnScratch scratch;
  std::pmr::vector<uint32_t> order(values.size(), scratch.memory());
  std::iota(order.begin(), order.end(), 0u);
  std::sort(order.begin(), order.end(), [&](uint32_t a, uint32_t b) {
    return values[a] != values[b] ? values[a] < values[b] : a < b;
  });
  Spread out;
  for (size_t i = 0; i < values.size(); ++i) out.mean += weights[i] * values[i];
  double variance = 0, cumulated = 0;
  bool low_found = false;
  out.p95 = values[order.back()];
  for (const uint32_t i : order) {
    variance += weights[i] * (values[i] - out.mean) * (values[i] - out.mean);
    const double before = cumulated;
    cumulated += weights[i];
    if (!low_found && cumulated >= 0.05) {
      out.p05 = values[i];
      low_found = true;
    }
    if (before < 0.95 && cumulated >= 0.95) out.p95 = values[i];
  }
  out.sd = std::sqrt(variance);
  return out;
}

FrameEstimate estimate_frame(const BodyModel& model, std::span<const WalkerParticle> particles,
                             std::span<const double> weights, double dt, int threads) {
  const size_t n = particles.size();
  const size_t joints = model.body.groups.arms ? size_t{kJointCount} : kJointCountWithoutArms;
  std::vector<JointPositions> positions(n);
  parallel_for(n, threads, [&](size_t i) {
    positions[i] = forward_kinematics(model.body, particles[i].pose).joints;
  });
  FrameEstimate out;
  out.joint_count = joints;
  parallel_for(joints * 3, threads, [&](size_t column) {
    ColumnScratch scratch;
    std::pmr::vector<double> values(n, scratch.memory());
    for (size_t i = 0; i < n; ++i)
      values[i] = positions[i].at[column / 3][static_cast<Eigen::Index>(column % 3)];
    out.spread[column / 3][column % 3] = weighted_spread(values, weights);
  });
  for (size_t j = 0; j < joints; ++j)
    for (size_t axis = 0; axis < 3; ++axis)
      out.joints.at[j][static_cast<Eigen::Index>(axis)] = out.spread[j][axis].mean;
  const double reference = particles[0].pose.heading;
  for (size_t i = 0; i < n; ++i) {
    add_pose(particles[i].pose, weights[i], reference, out.pose);
    if (particles[i].stance == Side::kLeft) out.left_stance += weights[i];
    const Eigen::Vector3d moved = particles[i].pose.root - particles[i].pose_before.root;
    out.speed += weights[i] * moved.head<2>().norm() / dt;
  }
  out.pose.heading += reference;
  spread_angles(particles, weights, threads, out);
  out.since_transfer =
      since_transfer(particles, weights, out.left_stance > 0.5 ? Side::kLeft : Side::kRight);
  return out;
}

}  // namespace tracker
}  // namespace walktrack
