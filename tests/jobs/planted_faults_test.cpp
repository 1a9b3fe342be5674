// Evaluation must detect every fault that a tracker is likely to have. Each fault is planted into a
// good estimate of a generated walk; at least one error then has to leave the band of good
// estimates.
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/conventions.h"
#include "core/rng.h"
#include "jobs/evaluate/evaluate.h"
#include "synth/walk/made_walk.h"
#include "tests/body/changed_motion.h"

namespace walktrack {
namespace {

using Eigen::Vector3d;

constexpr double kFrameRate = 30;

Motion true_walk() {
  MadeWalk walk;
  walk.rate = kFrameRate;
  walk.to = 5;
  return made_walk(make_body(Subject{}, {.head = true, .arms = false}), walk);
}

Motion noisy(const Motion& motion, double sd, uint64_t seed) {
  Rng rng(seed, Purpose::kTest);
  return changed(motion, [&](JointPositions& joints, size_t) {
    for (Vector3d& p : joints.at)
      for (double& x : p) x += sd * rng.normal();
  });
}

JointUncertainty stated(const Motion& motion, double sd) {
  JointUncertainty out{motion.time, motion.joints, motion.joints, motion.joints};
  for (size_t i = 0; i < motion.time.size(); ++i) {
    for (size_t j = 0; j < kJointCount; ++j) {
      out.p05[i].at[j].array() -= 1.645 * sd;
      out.p95[i].at[j].array() += 1.645 * sd;
    }
  }
  return out;
}

constexpr double kNoise = 0.003;  // m, of a good estimate

std::map<std::string, double> figures_of(const Motion& estimate, double stated_sd = kNoise) {
  std::map<std::string, double> out;
  for (const Figure& figure : figures(true_walk(), estimate, stated(estimate, stated_sd)))
    out[figure.key] = figure.value;
  return out;
}

struct Band {
  const char* key;
  double low, high;
};

// Wide enough for 3 mm of noise (four times its effect), far narrower than any fault below.
constexpr Band kBands[] = {
    {"joint_error_mean_mm", 0, 8},
    {"joint_error_relative_mm", 0, 10},
    {"filled_percent", 99, 100},
    {"swapped_percent", 0, 1},
    {"angle_lknee_flexion_bias_deg", -3, 3},
    {"angle_heading_bias_deg", -2, 2},
    {"event_late_ms", -15, 15},
    {"events_missed", 0, 0},
    {"events_extra", 0, 0},
    {"foot_slide_mean_mm", 0, 15},
    {"penetration_mm", 0, 12},
    {"coverage90_percent", 85, 95},
    {"jitter_m_s3", 0, 1500},
};

std::vector<std::string> left_bands(const std::map<std::string, double>& found) {
  std::vector<std::string> out;
  for (const Band& band : kBands) {
    const double value = found.at(band.key);
    if (!(value >= band.low && value <= band.high))
      out.push_back(std::string(band.key) + " = " + std::to_string(value));
  }
  return out;
}

Motion good() { return noisy(true_walk(), kNoise, 1); }

TEST(PlantedFaults, GoodEstimatesStayInTheBands) {
  for (uint64_t seed = 1; seed <= 5; ++seed)
    EXPECT_THAT(left_bands(figures_of(noisy(true_walk(), kNoise, seed))), testing::IsEmpty());
}

TEST(PlantedFaults, EachLeavesABand) {
  const Motion base = good();
  const Vector3d start = base.joints[0][Joint::kPelvis];
  using Change = std::function<void(JointPositions&, size_t)>;
  const std::map<std::string, Change> faults{
      {"legs swapped", [](JointPositions& j, size_t) { mirror_legs(j); }},
      {"legs swapped for a second",
       [](JointPositions& j, size_t i) {
         if (i >= 60 && i < 90) mirror_legs(j);
       }},
      {"wrong sign of the knees' flexion", [](JointPositions& j, size_t) { flip_knees(j); }},
      {"one frame late", [&](JointPositions& j, size_t i) { j = base.joints[i == 0 ? 0 : i - 1]; }},
      {"2 % too large",
       [&](JointPositions& j, size_t) {
         for (Vector3d& p : j.at) p = start + 1.02 * (p - start);
       }},
      {"a camera that is 20 mm off",
       [](JointPositions& j, size_t) {
         for (Vector3d& p : j.at) p.y() += 0.02;
       }},
      {"5 degrees of heading",
       [](JointPositions& j, size_t) {
         const Vector3d pelvis = j[Joint::kPelvis];
         const Eigen::AngleAxisd turn(rad_from_deg(5), Vector3d::UnitZ());
         for (Vector3d& p : j.at) p = pelvis + turn * (p - pelvis);
       }},
      {"lost for half a second",
       [](JointPositions& j, size_t i) {
         if (i >= 70 && i < 85) j = unknown_joints();
       }},
      {"frozen at the end",
       [&](JointPositions& j, size_t i) {
         if (i > 120) j = base.joints[120];
       }},
      {"feet that slide with the pelvis",
       [&](JointPositions& j, size_t i) {
         for (const Side side : {Side::kLeft, Side::kRight})
           for (const Joint joint : {ankle(side), toe(side)})
             j[joint].x() += 0.04 * std::sin(0.5 * static_cast<double>(i));
       }},
      {"feet in the ground",
       [](JointPositions& j, size_t) {
         for (Vector3d& p : j.at) p.z() -= 0.04;
       }},
  };
  for (const auto& [name, change] : faults)
    EXPECT_THAT(left_bands(figures_of(changed(base, change))), testing::Not(testing::IsEmpty()))
        << name;
}

TEST(PlantedFaults, TremblingAndOverconfidenceLeaveABand) {
  EXPECT_THAT(left_bands(figures_of(noisy(true_walk(), 0.012, 1), 0.012)),
              testing::Not(testing::IsEmpty()));
  EXPECT_THAT(left_bands(figures_of(good(), kNoise / 2)), testing::Not(testing::IsEmpty()));
  EXPECT_THAT(left_bands(figures_of(good(), kNoise * 2)), testing::Not(testing::IsEmpty()));
}

}  // namespace
}  // namespace walktrack
