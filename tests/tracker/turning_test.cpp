// Somebody who turns before one camera is followed by components that turn.
#include "tracker/modes/turning.h"

#include <cmath>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "fixture.h"
#include "made_evidence.h"
#include "tests/observation/scenes.h"
#include "tests/tracker/frame_time.h"
#include "tracker/tracker.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;

struct Walk {
  std::vector<Pose> poses;
  std::vector<SceneEvidence> frames;
};

// Seen by one camera at the side.
class TurningWalk : public testing::Test {
 protected:
  TurningWalk() : scene_(unseen(test_model(), kDt)) {
    scene_.cameras.push_back(
        camera_at({0.5, -4.5, 1.3}, {0.5, 0, 0.9}, 220, kEvidenceWidth, kEvidenceHeight));
    scene_.initial = DetectedWalk{.position = {-0.8, 0}, .velocity = {kSpeed, 0}, .given = true};
  }

  // Walks along +x for a second and then turns to the left, rad/s.
  Walk walk(double yaw_rate, double seconds) const {
    const PriorGait gait = usual_gait(scene_.model, prior_, kSpeed, 0);
    Walk out;
    Vector2d place = scene_.initial->position;
    double heading = 0;
    for (int t = 0; t < frames_in(seconds, kDt); ++t) {
      const double steps = std::fmod(t * kDt / gait.period, 2);
      Pose pose = pose_in_gait(scene_.model, gait, steps < 1 ? Side::kLeft : Side::kRight,
                               steps - std::floor(steps));
      pose.root.head<2>() = place;
      pose.heading = heading;
      out.poses.push_back(pose);
      SceneEvidence& frame = out.frames.emplace_back();
      for (const Camera& camera : scene_.cameras)
        frame.push_back(evidence_of(camera, scene_.model.body, pose));
      if (t * kDt > 1) heading += yaw_rate * kDt;
      place += kSpeed * kDt * Vector2d(std::cos(heading), std::sin(heading));
    }
    return out;
  }

  std::vector<FrameRecord> tracked(const Walk& walk, uint64_t seed, double turning_yaw_rate_sd) {
    TrackerConfig config;
    config.motion.turning_yaw_rate_sd = turning_yaw_rate_sd;
    config.filter.particles = 60;
    Tracker tracker(scene_, prior_, config, seed, 1);
    std::vector<FrameRecord> out;
    const auto take = [&](std::vector<FrameRecord> records) {
      for (FrameRecord& record : records) out.push_back(std::move(record));
    };
    for (const SceneEvidence& frame : walk.frames) take(tracker.push(frame));
    take(tracker.finish());
    return out;
  }

  // Mean distance of the root over the ground in the last half second, m.
  static double end_error(const Walk& walk, const std::vector<FrameRecord>& records) {
    const size_t count = size_t(frames_in(0.5, kDt));
    double sum = 0;
    for (size_t i = walk.poses.size() - count; i < walk.poses.size(); ++i)
      sum += (records[i].estimate.pose.root - walk.poses[i].root).head<2>().norm();
    return sum / double(count);
  }

  static constexpr double kSpeed = 1.2, kTurns = 0.6;
  GaitPrior prior_ = load_gait_prior();
  TrackerScene scene_;
};

// Without them, or with components that keep their heading, the figure is 0.7 m off and more.
TEST_F(TurningWalk, IsFollowedToItsEnd) {
  const Walk turn = walk(rad_from_deg(90), 3);
  constexpr int kSeeds = 3;
  double with = 0, alone = 0;
  for (uint64_t seed = 1; seed <= kSeeds; ++seed) {
    const std::vector<FrameRecord> records = tracked(turn, seed, kTurns);
    ASSERT_EQ(records.size(), turn.frames.size());
    with += end_error(turn, records) / kSeeds;
    alone += end_error(turn, tracked(turn, seed, 0)) / kSeeds;
  }
  EXPECT_LT(with, 0.15);
  EXPECT_GT(alone, 0.5);
}

// The track leaves somebody who turns, and is lost, before components are decided.
TEST_F(TurningWalk, AComponentReplacesATrackThatIsLost) {
  const Walk turn = walk(rad_from_deg(90), 3);
  scene_.initial.reset();
  for (const uint64_t seed : {2, 3, 6}) {
    const std::vector<FrameRecord> records = tracked(turn, seed, kTurns);
    ASSERT_EQ(records.size(), turn.frames.size());
    for (const FrameRecord& record : records) EXPECT_TRUE(record.tracked);
    EXPECT_LT(end_error(turn, records), 0.15);
  }
}

// Components that do not win leave no trace. (With one seed of twelve a component wins, which is
// nearer to the truth.)
TEST_F(TurningWalk, StraightAheadIsTrackedAsIfThereWereNone) {
  constexpr uint64_t kNoneWins = 2;
  const Walk straight = walk(0, 3);
  const std::vector<FrameRecord> with = tracked(straight, kNoneWins, kTurns),
                                 alone = tracked(straight, kNoneWins, 0);
  ASSERT_EQ(with.size(), straight.frames.size());
  ASSERT_EQ(alone.size(), straight.frames.size());
  for (size_t i = 0; i < with.size(); ++i) {
    EXPECT_EQ(with[i].tracked, alone[i].tracked);
    EXPECT_EQ(with[i].estimate.pose.root, alone[i].estimate.pose.root);
    EXPECT_EQ(with[i].filter.log_evidence, alone[i].filter.log_evidence);
  }
}

// Frames of a trial are not reported before it is decided, and there is no state to resume from.
TEST_F(TurningWalk, FramesWaitUntilComponentsAreDecided) {
  const Walk straight = walk(0, 3);
  Tracker tracker(scene_, prior_, {}, 1, 1);
  size_t reported = 0, waited = 0;
  for (size_t i = 0; i < straight.frames.size(); ++i) {
    reported += tracker.push(straight.frames[i]).size();
    if (!tracker.tracking()) continue;
    EXPECT_EQ(tracker.has_state(), reported == i + 1);
    waited = std::max(waited, i + 1 - reported);
  }
  EXPECT_EQ(waited, size_t(frames_in(1.25, kDt)) - 1);
  EXPECT_EQ(reported + tracker.finish().size(), straight.frames.size());
}

TEST(TurningTrial, OnlyOneCameraNeedsComponents) {
  EXPECT_GT(turning_components({}, Path::kSpatial, 1), 0);
  EXPECT_EQ(turning_components({}, Path::kSpatial, 2), 0);
  EXPECT_EQ(turning_components({}, Path::kSagittal, 1), 0);
  MotionConfig straight;
  straight.turning_yaw_rate_sd = 0;
  EXPECT_EQ(turning_components(straight, Path::kSpatial, 1), 0);
}

TEST(TurningTrial, OnlyAClearLeadReplacesTheTrack) {
  TurningTrial trial;
  EXPECT_EQ(winner(trial), nullptr);
  for (const double lead : {20.0, 99.0, -300.0})
    trial.components.push_back({WalkerFilter({}, 1, 1), 0.6, 1, lead});
  EXPECT_EQ(winner(trial), nullptr);
  trial.components[0].lead = 101;
  EXPECT_EQ(winner(trial), &trial.components[0]);
  trial.components[2].lead = 500;
  EXPECT_EQ(winner(trial), &trial.components[2]);
}

}  // namespace
}  // namespace walktrack
