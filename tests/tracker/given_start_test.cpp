// A given start is at the place that the scene states, to MotionConfig::given_position_sd.
#include <gtest/gtest.h>

#include "fixture.h"
#include "tests/tracker/frame_time.h"
#include "tracker/tracker.h"

namespace walktrack {
namespace {

// Standard deviation of the pelvis over the ground in the first frame without evidence, m.
double first_spread(double given, double arrival) {
  TrackerScene scene = unseen(test_model(), kDt);
  scene.initial = DetectedWalk{.position = {1, 2}, .velocity = {0, 1.2}, .given = true};
  TrackerConfig config;
  config.motion.given_position_sd = given;
  config.motion.start_position_sd = arrival;
  const GaitPrior prior = load_gait_prior();
  Tracker tracker(scene, prior, config, 1, 1);
  for (int frame = 0; frame < frames_in(config.start.seconds, kDt); ++frame) {
    const std::vector<FrameRecord> records = tracker.push({});
    if (records.empty()) continue;
    const FrameEstimate& first = records.front().estimate;
    EXPECT_NEAR(first.joints[Joint::kPelvis].x(), 1, 0.1);
    EXPECT_NEAR(first.joints[Joint::kPelvis].y(), 2, 0.1);
    return first.spread[size_t(Joint::kPelvis)][0].sd;
  }
  ADD_FAILURE() << "the start was not decided";
  return 0;
}

TEST(GivenStart, IsAsUncertainAsItIsSaidToBe) {
  const double narrow = first_spread(0.02, 0.15), wide = first_spread(0.3, 0.15);
  EXPECT_NEAR(std::sqrt(wide * wide - narrow * narrow), 0.3, 0.05);
}

TEST(GivenStart, DoesNotDependOnWhatFoundOnesAre) {
  EXPECT_EQ(first_spread(0.1, 0.02), first_spread(0.1, 0.5));
}

}  // namespace
}  // namespace walktrack
