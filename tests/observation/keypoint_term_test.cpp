#include "observation/keypoints/keypoint_term.h"

#include <cmath>
#include <functional>
#include <numeric>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "observation/observer.h"
#include "tests/observation/scenes.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;

constexpr double kPersonHeight = 1.75;

constexpr std::array kLegNames{KeypointName::kLeftHip,    KeypointName::kRightHip,
                               KeypointName::kLeftKnee,   KeypointName::kRightKnee,
                               KeypointName::kLeftAnkle,  KeypointName::kRightAnkle,
                               KeypointName::kLeftBigToe, KeypointName::kRightBigToe,
                               KeypointName::kLeftHeel,   KeypointName::kRightHeel};
constexpr std::array kArmNames{KeypointName::kLeftShoulder, KeypointName::kRightShoulder,
                               KeypointName::kLeftElbow,    KeypointName::kRightElbow,
                               KeypointName::kLeftWrist,    KeypointName::kRightWrist};

// A person seen from the side, and the detector that sees them.
struct SeenFromTheSide : testing::Test {
  Body body = make_body(Subject{}, {.head = true, .arms = true});
  Camera camera = camera_at({0, -5, 1.2}, {0, 0, 0.9}, 600, 640, 480);
  ObservationConfig config = keypoints_alone();

  static ObservationConfig keypoints_alone() {
    ObservationConfig out;
    out.background.enabled = out.foreground.enabled = false;
    out.keypoints.enabled = TermSetting::kOn;
    return out;
  }
  static Pose pose(double x) {
    Pose out;
    out.root = {x, 0, 0.92};
    out.legs[0] = {0.4, 0, 0, 0.1, 0};
    out.legs[1] = {-0.2, 0, 0, 0.3, 0};
    out.arms[0] = {-0.3, 0.1, 0.2};
    out.arms[1] = {0.4, 0.1, 0.4};
    return out;
  }
  PosedBody posed(const Pose& p) const { return {body, p}; }

  // Every point exactly at the body model's.
  DetectedPerson seen(const Pose& p, float confidence = 0.8F) const {
    const PointPixels px = point_pixels(camera, posed(p), offsets());
    DetectedPerson out;
    const auto put = [&](KeypointName name, size_t point) {
      out[name] = {static_cast<float>(px[point].x()), static_cast<float>(px[point].y()),
                   confidence};
    };
    put(KeypointName::kNose, 0);
    for (size_t i = 0; i < kArmNames.size(); ++i) put(kArmNames[i], kFirstArmPoint + i);
    for (size_t i = 0; i < kLegNames.size(); ++i) put(kLegNames[i], kFirstLegPoint + i);
    return out;
  }
  static PointOffsets offsets() {
    PointOffsets out;
    out.fill(Vector2d::Zero());
    return out;
  }

  Observer observer(int shrink = 1) const {
    return Observer(config, {.camera = camera,
                             .shrink = shrink,
                             .appearances = appearances_of(body),
                             .background = {},
                             .occluders = {},
                             .pictures = false});
  }
  CameraEvidence evidence(const DetectedPeople& people, int shrink = 1) const {
    Observer watching = observer(shrink);
    CameraEvidence out;
    watching.observe({}, whole_image(watching.camera(), 0.01), out, people);
    return out;
  }
  double score(const CameraEvidence& evidence, const Pose& p) const {
    return still_log_likelihood(config, evidence, camera, posed(p));
  }
};

void swap_names(DetectedPerson& person, std::span<const KeypointName> names) {
  for (size_t i = 0; i < names.size(); i += 2) std::swap(person[names[i]], person[names[i + 1]]);
}

using KeypointTermTest = SeenFromTheSide;

TEST_F(KeypointTermTest, OffOrUnseenCostsAndSaysNothing) {
  config.keypoints.enabled = TermSetting::kOff;
  const CameraEvidence off = evidence({seen(pose(0))});
  EXPECT_EQ(off.keypoints.people.capacity(), 0U);
  EXPECT_FALSE(KeypointTerm::says(off));
  EXPECT_EQ(score(off, pose(0)), 0);
  EXPECT_TRUE(KeypointTerm::cost(config, {}).empty());
  config.keypoints.enabled = TermSetting::kOn;
  const CameraEvidence nobody = evidence({});
  EXPECT_EQ(nobody.keypoints.people.capacity(), 0U);
  EXPECT_EQ(score(nobody, pose(0)), 0);
}

TEST_F(KeypointTermTest, TruePoseBeatsPerturbedPoses) {
  const CameraEvidence seen_now = evidence({seen(pose(0))});
  const double best = score(seen_now, pose(0));
  EXPECT_GT(best, 1);
  const std::vector<std::function<void(Pose&)>> changes{
      [](Pose& p) { p.root.x() += 0.05; },
      [](Pose& p) { p.root.x() -= 0.05; },
      [](Pose& p) { p.root.z() += 0.05; },
      [](Pose& p) { p.tilt += 0.2; },
      [](Pose& p) { p.legs[0].hip_flexion += 0.2; },
      [](Pose& p) { p.legs[1].knee_flexion += 0.3; },
      [](Pose& p) { p.arms[1].elbow_flexion += 0.5; },
      [](Pose& p) { p.root.y() += 0.5; }};
  for (size_t i = 0; i < changes.size(); ++i) {
    Pose other = pose(0);
    changes[i](other);
    EXPECT_LT(score(seen_now, other), best) << i;
  }
}

// The same person in an image of half the size gives the same evidence.
TEST_F(KeypointTermTest, PixelsAreThoseOfThePictureAsRecorded) {
  const CameraEvidence whole = evidence({seen(pose(0))}), half = evidence({seen(pose(0))}, 2);
  for (size_t i = 0; i < kBodyPoints; ++i) {
    const Vector2d px = whole.keypoints.people[0][i].px;
    EXPECT_TRUE(
        half.keypoints.people[0][i].px.isApprox(Vector2d((px.array() + 0.5) / 2 - 0.5), 1e-9));
  }
}

TEST_F(KeypointTermTest, SwappedNamesCostTheirLogOddsAlone) {
  const double odds = std::log1p(-config.keypoints.flip) - std::log(config.keypoints.flip);
  DetectedPerson legs = seen(pose(0)), both = legs;
  swap_names(legs, kLegNames);
  swap_names(both, kLegNames);
  swap_names(both, kArmNames);
  config.keypoints.weight = 1;  // so that swapped labels are practically excluded
  const double best = score(evidence({seen(pose(0))}), pose(0));
  EXPECT_NEAR(best - score(evidence({legs}), pose(0)), odds, 0.01);
  EXPECT_NEAR(best - score(evidence({both}), pose(0)), 2 * odds, 0.02);
}

TEST_F(KeypointTermTest, MissingPointsSayNothing) {
  DetectedPerson person = seen(pose(0));
  for (const KeypointName name : kLegNames) person[name].confidence = 0;
  const CameraEvidence upper = evidence({person});
  Pose other = pose(0);
  for (LegPose& leg : other.legs) leg.knee_flexion += 0.4;
  EXPECT_EQ(score(upper, other), score(upper, pose(0)));
  for (Keypoint& point : person.points) point = {0, 0, 0};
  EXPECT_FALSE(KeypointTerm::says(evidence({person})));
  person[KeypointName::kNose] = {NAN, 3, 1};
  EXPECT_FALSE(KeypointTerm::says(evidence({person})));
}

TEST_F(KeypointTermTest, UnsurePointsBindLess) {
  const auto cost = [&](float confidence) {
    const CameraEvidence points = evidence({seen(pose(0), confidence)});
    return score(points, pose(0)) - score(points, pose(0.05));
  };
  EXPECT_GT(cost(0.9F), 1.2 * cost(0.45F));
  EXPECT_GT(cost(0.45F), 1.2 * cost(0.2F));
}

TEST_F(KeypointTermTest, SomebodyElseChangesNothing) {
  const DetectedPerson subject = seen(pose(0));
  Pose far = pose(1.4);
  far.root.y() = 3;
  const CameraEvidence alone = evidence({subject}), two = evidence({seen(far), subject});
  for (const double x : {0.0, 0.02, 0.1})
    EXPECT_NEAR(score(two, pose(x)), score(alone, pose(x)), 1e-3) << x;
  // Other people alone have no effect on poses that are far from them.
  const CameraEvidence other = evidence({seen(far)});
  EXPECT_NEAR(score(other, pose(0)), 0, 1e-3);
  EXPECT_NEAR(score(other, pose(0.1)), 0, 1e-3);
}

// Beside the camera and behind it points have no place in the image, or an arbitrary one.
TEST_F(KeypointTermTest, AnyPoseHasAFiniteScore) {
  const CameraEvidence seen_now = evidence({seen(pose(0)), seen(pose(0.5))});
  for (const double y : {-4.9, -5.0, -5.1, -9.0}) {
    for (const double x : {0.0, 0.3, 1e3}) {
      Pose there = pose(x);
      there.root.y() = y;
      EXPECT_TRUE(std::isfinite(score(seen_now, there))) << x << " " << y;
    }
  }
}

// Computed independently: every choice of person and labels, one density after the other.
double brute_force(const KeypointConfig& config, const KeypointEvidence& evidence,
                   const PointPixels& predicted) {
  double sum = 1;
  for (const auto& person : evidence.people) {
    for (const bool arms : {false, true}) {
      for (const bool legs : {false, true}) {
        double product =
            (arms ? config.flip : 1 - config.flip) * (legs ? config.flip : 1 - config.flip);
        for (size_t i = 0; i < kBodyPoints; ++i) {
          if (person[i].precision == 0) continue;
          const bool swapped = i >= kFirstLegPoint ? legs : i >= kFirstArmPoint && arms;
          const double r2 = (person[i].px - predicted[swapped ? mirrored(i) : i]).squaredNorm();
          product *= std::pow(std::exp(person[i].at_best) *
                                  std::pow(1 + person[i].precision * r2, -(config.dof + 2) / 2),
                              config.weight);
        }
        sum += product;
      }
    }
  }
  return std::log(sum);
}

TEST_F(KeypointTermTest, MarginalIsTheSumOverPeopleAndNames) {
  Rng rng(3, Purpose::kTest);
  DetectedPerson near = seen(pose(0.1)), swapped = seen(pose(0.05), 0.4F);
  swap_names(swapped, kLegNames);
  for (Keypoint& point : near.points) {
    point.x_px += static_cast<float>(3 * rng.normal());
    if (rng.uniform() < 0.2) point.confidence = 0;
  }
  const CameraEvidence all = evidence({near, swapped, seen(pose(1))});
  for (const double x : {0.0, 0.05, 0.1, 0.5}) {
    const PointPixels predicted = point_pixels(camera, posed(pose(x)), all.keypoints.offsets);
    EXPECT_NEAR(score(all, pose(x)), brute_force(config.keypoints, all.keypoints, predicted), 1e-9);
  }
}

TEST_F(KeypointTermTest, NamesOfATrackAreThoseOfMostPoints) {
  const CameraEvidence right = evidence({seen(pose(0))});
  DetectedPerson person = seen(pose(0));
  swap_names(person, kLegNames);
  const CameraEvidence wrong = evidence({person});
  const PosedBody now = posed(pose(0));
  const auto odds = [&](const CameraEvidence& each) {
    return KeypointTerm::names_log_odds(config, body, camera, each, each, now, now);
  };
  EXPECT_GT(odds(right), 1);
  EXPECT_NEAR(odds(wrong), -odds(right), 1e-9);
}

// A detector with errors of half a per cent of the height, and hips that are two per cent too high.
struct Learning : SeenFromTheSide {
  CameraEvidence now;
  Observer watching = observer();

  void watch(int frames) {
    Rng rng(9, Purpose::kTest);
    const double px_per_m = camera.focal_px.x() / 5;
    for (int f = 0; f < frames; ++f) {
      const Pose here = pose(0.2 * std::sin(0.1 * f));
      DetectedPerson person = seen(here);
      for (Keypoint& point : person.points) {
        point.x_px += static_cast<float>(0.005 * kPersonHeight * px_per_m * rng.normal());
        point.y_px += static_cast<float>(0.005 * kPersonHeight * px_per_m * rng.normal());
      }
      for (const KeypointName name : {KeypointName::kLeftHip, KeypointName::kRightHip})
        person[name].y_px -= static_cast<float>(0.02 * kPersonHeight * px_per_m);
      watching.observe({}, whole_image(camera, 0.01), now, {person});
      const PosedBody found = posed(here);
      watching.learn(now, project_parts(camera, found.parts), &found);
    }
  }
};

using KeypointErrorsTest = Learning;

TEST_F(KeypointErrorsTest, AreLearntFromTheRecording) {
  const KeypointErrors before = watching.state().errors;
  watch(300);
  const KeypointErrors after = watching.state().errors;
  const auto knee = static_cast<size_t>(PointKind::kKnee);
  EXPECT_LT(after.scale[knee], 0.5 * before.scale[knee]);
  const Vector2d hip = offsets_of(after)[static_cast<size_t>(PointKind::kHip)];
  EXPECT_NEAR(hip.y(), 0.02, 0.006);  // the prior pulls towards none
  EXPECT_NEAR(hip.x(), 0, 0.005);
  EXPECT_NEAR(offsets_of(after)[knee].norm(), 0, 0.004);
  EXPECT_EQ(watching.state().use.matched, 300);
  EXPECT_EQ(watching.state().use.legs_flipped, 0);
}

TEST_F(KeypointErrorsTest, OfSomebodyElseAreNotLearnt) {
  Pose far = pose(1.4);
  far.root.y() = 3;
  const PosedBody found = posed(pose(0));
  watching.observe({}, whole_image(camera, 0.01), now, {seen(far)});
  watching.learn(now, project_parts(camera, found.parts), &found);
  EXPECT_EQ(watching.state().use.frames, 1);
  EXPECT_EQ(watching.state().use.matched, 0);
  EXPECT_EQ(watching.state().errors.scale, initial_errors().scale);
}

// An observer that takes the state of another one continues in the same way.
TEST_F(KeypointErrorsTest, ContinueFromAState) {
  watch(20);
  Observer other = observer();
  other.resume(watching.state());
  CameraEvidence a, b;
  watching.observe({}, whole_image(camera, 0.01), a, {seen(pose(0))});
  other.observe({}, whole_image(camera, 0.01), b, {seen(pose(0))});
  EXPECT_EQ(score(a, pose(0.03)), score(b, pose(0.03)));
}

}  // namespace
}  // namespace walktrack
