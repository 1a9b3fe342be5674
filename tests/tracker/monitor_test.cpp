#include "tracker/modes/monitor.h"

#include <gtest/gtest.h>

#include "tests/tracker/frame_time.h"
#include "tracker/tracker_scene.h"

namespace walktrack {
namespace {

constexpr double kNobody = -1e9;  // score of a figure that explains nothing

// Number of frames with this likelihood until the track is lost, after a second at 100 nats; all of
// them if it never is.
int frames_until_lost(double log_likelihood, double figure, int most = 200) {
  MonitorState state;
  begin_watch(std::deque<double>(30, 100.0), state);
  for (int frame = 1; frame <= most; ++frame)
    if (is_fading({}, 1, kDt, log_likelihood, figure, state)) return frame;
  return most;
}

TEST(Monitor, AWalkerMayBeHiddenForAWhile) {
  const MonitorConfig config;
  EXPECT_EQ(frames_until_lost(101 * config.lost_below, kNobody), 200);
  EXPECT_EQ(frames_until_lost(99 * config.lost_below, kNobody), frames_in(config.lost_after, kDt));
}

TEST(Monitor, AStiffFigureThatDoesBetterEndsATrackSooner) {
  EXPECT_EQ(frames_until_lost(80, 85), 200) << "nearly as well will do";
  EXPECT_EQ(frames_until_lost(80, 95), frames_in(MonitorConfig{}.outscored_after, kDt));
}

// A track that fades slowly is not compared with frames in which it had faded.
TEST(Monitor, BadFramesAreNotTheMeasureOfGoodOnes) {
  MonitorState state;
  begin_watch(std::deque<double>(10, 100.0), state);
  for (int i = 0; i < 5; ++i) is_fading({}, 1, kDt, 10, kNobody, state);
  EXPECT_EQ(state.frames_below, 5);
  EXPECT_EQ(state.log_likelihoods.size(), 10u);
  EXPECT_FALSE(is_fading({}, 1, kDt, 90, kNobody, state));
  EXPECT_EQ(state.frames_below, 0);
  EXPECT_EQ(state.log_likelihoods.back(), 90);
}

// A start may take longer than the time of which the median is taken.
TEST(Monitor, RemembersTheNewestFramesOfALongStart) {
  const MonitorConfig config;
  MonitorState state;
  begin_watch(std::deque<double>(100, 50.0), state);
  is_fading(config, 1, kDt, 100, kNobody, state);
  EXPECT_EQ(state.log_likelihoods.size(), size_t(frames_in(config.evidence_window, kDt)));
  EXPECT_EQ(state.log_likelihoods.back(), 100);
}

// An empty scene explains nothing: below the least score a track is lost whatever came before.
TEST(Monitor, LowScoresAreLost) {
  MonitorState state;
  begin_watch(std::deque<double>(10, 0.5), state);
  int frames = 1;
  while (!is_fading({}, 1, kDt, 0.5, kNobody, state)) ++frames;
  EXPECT_EQ(frames, frames_in(MonitorConfig{}.lost_after, kDt));
}

TEST(Monitor, OffAllPeopleForAWhileIsLost) {
  const MonitorConfig config;
  const int most = frames_in(config.off_detected_after, kDt);
  const auto lost_after = [&](std::optional<bool> every_other) {
    MonitorState state;
    for (int frame = 1; frame < 100; ++frame)
      if (is_off_people(config, kDt, frame % 2 ? std::optional(false) : every_other, state))
        return frame;
    return 100;
  };
  EXPECT_EQ(lost_after(false), most);
  EXPECT_EQ(lost_after(std::nullopt), most) << "frames without keypoints go on counting";
  EXPECT_EQ(lost_after(true), 100);
  MonitorState state;
  for (int frame = 0; frame < 100; ++frame)
    EXPECT_FALSE(is_off_people(config, kDt, std::nullopt, state)) << "nobody's are seen";
}

TEST(Monitor, LooksWhereTheWalkerCanBe) {
  const MonitorConfig config;
  MonitorState state;
  const auto can_be = [&](const Eigen::Vector2d& place, double seconds, double last_x = 100) {
    const auto reach =
        reach_of(config, state.last_seen, 59 + static_cast<uint32_t>(frames_in(seconds, kDt)), kDt,
                 [=](const Eigen::Vector2d& p) { return p.x() < last_x; });
    return !reach || reach->contains(place);
  };
  EXPECT_TRUE(can_be({50, 50}, 1)) << "never seen";
  FrameEstimate estimate;
  estimate.pose.root = {1, 2, 0.9};
  estimate.speed = 1.2;  // along x
  for (uint32_t frame = 0; frame < 60; ++frame) see(estimate, frame, kDt, state);
  EXPECT_NEAR(state.last_seen->velocity.x(), 1.2, 1e-9);
  EXPECT_TRUE(can_be({2.2, 2}, 1)) << "they went on";
  EXPECT_TRUE(can_be({1.2, 2.5}, 1)) << "they stopped";
  EXPECT_FALSE(can_be({-0.5, 2}, 1)) << "somebody behind them";
  EXPECT_TRUE(can_be({-5, 2}, config.reacquire_within + 1)) << "anywhere by now";
  EXPECT_TRUE(can_be({-0.5, 2}, 1, 2)) << "they turned around where nobody saw it";
  EXPECT_FALSE(can_be({-3, 2}, 1, 2)) << "nobody is as fast as that";
}

}  // namespace
}  // namespace walktrack
