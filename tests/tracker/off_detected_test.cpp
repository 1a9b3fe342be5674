// A track is lost if its figure agrees with none of the people whose keypoints are detected.
#include <cmath>

#include <gtest/gtest.h>

#include "fixture.h"
#include "observation/keypoints/keypoint_points.h"
#include "tests/tracker/frame_time.h"
#include "tests/tracker/side_camera.h"
#include "tracker/tracker.h"

namespace walktrack {
namespace {

constexpr double kSpeed = 1.2;

// An upright person at a place, each point known to 3 px.
KeypointEvidence upright(const Body& body, const Camera& camera, double x) {
  Pose pose;
  pose.root = {x, 0, 0.52 * body.subject.height};
  KeypointEvidence out;
  out.offsets.fill(Eigen::Vector2d::Zero());
  const PointPixels px = point_pixels(camera, PosedBody(body, pose), out.offsets);
  KeypointEvidence::Person person;
  for (size_t i = 0; i < kBodyPoints; ++i)
    if (!needs_arms(kind_of(i))) person[i] = {px[i], 1.0 / (4 * 9), std::log(200.0)};
  out.people = {person};
  return out;
}

// Whether a person who walks along x is still tracked after their keypoints have been `aside` m
// beside them for some time.
bool tracked_after(double aside, double seconds) {
  TrackerScene scene = unseen(test_model(), kDt);
  scene.cameras = {side_camera(1.3)};
  scene.observation.background.enabled = scene.observation.foreground.enabled = false;
  scene.observation.keypoints.enabled = TermSetting::kOn;
  scene.initial = DetectedWalk{.position = {-1, 0}, .velocity = {kSpeed, 0}, .given = true};
  TrackerConfig config;
  config.filter.particles = 100;
  config.detector.window = 0.5;  // s
  config.monitor.lost_after = 100;
  const GaitPrior prior = load_gait_prior();
  Tracker tracker(scene, prior, config, 1, 1);
  const int before = frames_in(1.0, kDt), after = frames_in(seconds, kDt);
  for (int frame = 0; frame < before + after; ++frame) {
    const double x = -1 + kSpeed * kDt * frame + (frame < before ? 0 : aside);
    SceneEvidence evidence(1);
    evidence[0].keypoints = upright(scene.model.body, scene.cameras[0], x);
    tracker.push(evidence);
    if (frame == before - 1) {
      EXPECT_TRUE(tracker.tracking());
    }
  }
  return tracker.tracking();
}

TEST(OffDetected, LosesTheTrackAfterAWhile) {
  EXPECT_TRUE(tracked_after(0.5, 0.4));
  EXPECT_FALSE(tracked_after(0.5, 0.6));
}

TEST(OffDetected, KnowsOthersByTheirDistance) { EXPECT_TRUE(tracked_after(3, 1)); }

TEST(OffDetected, DoesNotWhereTheFigureLiesOnThem) { EXPECT_TRUE(tracked_after(0, 1)); }

}  // namespace
}  // namespace walktrack
