#include "observation/two_views/two_views.h"

#include <algorithm>
#include <cmath>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/conventions.h"
#include "core/errors.h"
#include "core/rng.h"
#include "tests/message_of.h"

namespace walktrack {
namespace {

using Eigen::Vector3d;

constexpr double kStature = 1.8;

// A walker of Winter's proportions at some time: towards +x at 1.2 m/s along y = 0, feet on the
// ground, the stance leg straight.
std::array<Vector3d, 17> walker(double time) {
  using enum KeypointName;
  constexpr double kLeg = (0.530 - 0.039) * kStature, kStep = 0.5, kPace = 1.2;
  const double x = kPace * time - 2, phase = kPi * x / kStep;
  std::array<Vector3d, 17> out;
  const auto set = [&](KeypointName name, double ahead, double left, double up) {
    out[static_cast<size_t>(name)] = {x + ahead, left, up};
  };
  const double swing = std::asin(0.5 * kStep / kLeg) * std::sin(phase);
  const double ankle = 0.039 * kStature + 0.01, hip = ankle + kLeg * std::cos(swing);
  const double lower = 0.530 * kStature - hip + 0.01;  // than in standing
  for (const int side : {0, 1}) {
    const double sign = side == 0 ? 1 : -1, leg = sign * swing;
    const auto of = [&](KeypointName left) {
      return static_cast<KeypointName>(static_cast<int>(left) + side);
    };
    set(of(kLeftHip), 0, sign * 0.09, hip);
    set(of(kLeftKnee), 0.5 * kLeg * std::sin(leg), sign * 0.09, hip - 0.5 * kLeg * std::cos(leg));
    set(of(kLeftAnkle), kLeg * std::sin(leg), sign * 0.09, ankle);
    set(of(kLeftShoulder), 0.02, sign * 0.19, 0.818 * kStature - lower);
    set(of(kLeftElbow), -0.2 * std::sin(leg), sign * 0.22, 0.63 * kStature - lower);
    set(of(kLeftWrist), -0.4 * std::sin(leg), sign * 0.22, 0.48 * kStature - lower);
    set(of(kLeftEye), 0.1, sign * 0.03, 0.936 * kStature - lower);
    set(of(kLeftEar), 0, sign * 0.07, 0.936 * kStature - lower);
  }
  set(kNose, 0.12, 0, 0.92 * kStature - lower);
  return out;
}

Camera camera_at(const Vector3d& place, const Vector3d& at, double focal_px) {
  Camera camera;
  camera.width_px = 720;
  camera.height_px = 1280;
  camera.focal_px.setConstant(focal_px);
  camera.centre_px = {359.5, 639.5};
  const Vector3d ahead = (at - place).normalized(),
                 right = ahead.cross(Vector3d::UnitZ()).normalized();
  camera.rotation.row(0) = right;
  camera.rotation.row(1) = ahead.cross(right);
  camera.rotation.row(2) = ahead;
  camera.translation = -camera.rotation * place;
  return camera;
}

// The observations of the camera, with a lag of `late` seconds and noise of `noise_px` for each
// point.
std::vector<SeenMoment> seen_by(const Camera& camera, double late, double noise_px, Rng& rng) {
  std::vector<SeenMoment> out;
  for (int frame = 0; frame < 60; ++frame) {
    SeenMoment moment{frame / 20.0, {}};
    const auto body = walker(moment.time - late);
    for (size_t i = 0; i < body.size(); ++i) {
      const auto at = project(camera, body[i]);
      moment.person.points[i] = {static_cast<float>(at->x() + noise_px * rng.normal()),
                                 static_cast<float>(at->y() + noise_px * rng.normal()), 0.8F};
    }
    out.push_back(moment);
  }
  return out;
}

LensAssumption lens(double focal_px, double sd) { return {720, 1280, focal_px, sd}; }

struct Rig {
  Camera first = camera_at({5, -1.2, 1.3}, {0, 0, 0.9}, 950),
         second = camera_at({4.5, 2, 1.1}, {0, 0, 0.9}, 900);
};

double turned(const Camera& a, const Camera& b) {
  const Eigen::Matrix3d turn = a.rotation * b.rotation.transpose();
  return std::acos(std::clamp(0.5 * (turn.trace() - 1), -1.0, 1.0));
}

// The pose of the second camera relative to the first, for any world.
Camera second_from_first(const Camera& first, const Camera& second) {
  Camera out = second;
  out.rotation = second.rotation * first.rotation.transpose();
  out.translation = second.translation - out.rotation * first.translation;
  return out;
}

TEST(TwoViews, OfAWalkerSeenExactlyAreExact) {
  const Rig rig;
  Rng rng(3, Purpose::kTest, 0);
  const TwoViews found = two_views(seen_by(rig.first, 0, 0, rng), seen_by(rig.second, 0, 0, rng),
                                   {{lens(950, 1), lens(900, 1)}, kStature, 0});
  const Camera truth = second_from_first(rig.first, rig.second),
               pose = second_from_first(found.cameras[0], found.cameras[1]);
  EXPECT_LT(deg_from_rad(turned(truth, pose)), 0.05);
  EXPECT_NEAR(pose.translation.norm() / truth.translation.norm(), 1, 0.01);
  EXPECT_NEAR(found.height[0].value, 1.3, 0.03);
  EXPECT_NEAR(found.height[1].value, 1.1, 0.03);
  EXPECT_NEAR(found.lag.value, 0, 1e-3);
  EXPECT_LT(found.residual, 1e-3);
  // In front of both cameras, and he walks towards them.
  EXPECT_LT(camera_point(found.cameras[0], found.places.back()).z(),
            camera_point(found.cameras[0], found.places.front()).z() - 2);
}

TEST(TwoViews, FindsTheLag) {
  const Rig rig;
  Rng rng(3, Purpose::kTest, 0);
  const TwoViews found = two_views(seen_by(rig.first, 0, 1, rng), seen_by(rig.second, 0.1, 1, rng),
                                   {{lens(950, 10), lens(900, 10)}, kStature, 0});
  EXPECT_NEAR(found.lag.value, 0.1, 0.015);
}

// With lenses that are wrong within their uncertainty, the stated bands contain the truth as often
// as they should.
TEST(TwoViews, BandsHold) {
  constexpr int kTrials = 12;
  const Rig rig;
  const Camera truth = second_from_first(rig.first, rig.second);
  int apart = 0, height = 0, focal = 0, angle = 0;
  for (int trial = 0; trial < kTrials; ++trial) {
    Rng rng(7, Purpose::kTest, static_cast<uint32_t>(trial));
    const double first = 950 * (1 + 0.07 * rng.normal()), second = 900 * (1 + 0.07 * rng.normal());
    const TwoViews found =
        two_views(seen_by(rig.first, 0, 5, rng), seen_by(rig.second, 0, 5, rng),
                  {{lens(first, 0.07 * first), lens(second, 0.07 * second)}, kStature, 0.01});
    const auto holds = [](const Measured& is, double value) {
      return std::abs(is.value - value) < 2 * is.sd;
    };
    apart += holds(found.apart, truth.translation.norm());
    height += holds(found.height[0], 1.3);
    focal += holds(found.focal_px[0], 950);
    angle += holds(found.angle, std::acos(truth.rotation(2, 2)));
  }
  // 95 % of 12, less two standard errors.
  for (const int held : {apart, height, focal, angle}) EXPECT_GE(held, 10);
}

TEST(TwoViews, SaysWhenThereIsTooLittle) {
  const Rig rig;
  Rng rng(3, Purpose::kTest, 0);
  const auto first = seen_by(rig.first, 0, 0, rng), second = seen_by(rig.second, 0, 0, rng);
  EXPECT_THAT(
      message_of([&] {
        two_views(std::span(first).first(10), second, {{lens(950, 1), lens(900, 1)}, kStature, 0});
      }),
      testing::HasSubstr("at least 20 are needed"));
}

}  // namespace
}  // namespace walktrack
