// A track before one camera is lost if a figure at another distance explains the images better.
#include "tracker/modes/loss.h"

#include <utility>

#include <gtest/gtest.h>

#include "walked_scene.h"

namespace walktrack {
namespace {

class Loss : public WalkedScene {
 protected:
  static constexpr size_t kFrames = 20;
  static constexpr double kUsualScore = 10;  // nats, of the frames before

  // The frame in which a track is lost whose figure has the subject's pose at so many times their
  // distance from the first camera; nullopt if it is not.
  std::optional<size_t> lost_in(double times, const std::vector<Eigen::Vector3d>& places) {
    show(0.2, kFrames, places);
    const TrackContext context = subject_->context();
    begin_watch({kUsualScore}, monitor_);
    monitor_.last_seen = LastSeen{.position = {50, 50}};
    const Eigen::Vector2d camera = places[0].head<2>();
    for (size_t t = 0; t < kFrames; ++t) {
      const Eigen::Vector2d truth = moved(walk_, double(t) * kDt).position;
      const std::span<const Pose> figures = context.subject.figures.at(kSpeed, 0);
      FrameRecord record;
      Pose& pose = record.estimate.pose;
      pose = figures[0];
      pose.root.head<2>() = camera + times * (truth - camera);
      record.mean_log_likelihood =
          place_score(context.scene, window_[t], context.body(), figures, pose.root.head<2>(), 0);
      if (is_lost(context, window_[t], static_cast<uint32_t>(t), record, monitor_)) return t;
    }
    return std::nullopt;
  }

  MonitorState monitor_;
};

TEST_F(Loss, TooFarAwayIsNoticedAndWhereTheyAreRather) {
  for (const auto& [times, within] : {std::pair{1.25, 0.5}, {1.5, 1.0}, {0.75, 0.8}}) {
    const auto lost = lost_in(times, {{6, 0.5, 1.2}});
    ASSERT_TRUE(lost) << times;
    EXPECT_GE(double(*lost) * kDt, 0.3);
    const Eigen::Vector2d truth = moved(walk_, double(*lost) * kDt).position;
    EXPECT_LT((monitor_.last_seen->position - truth).norm(), within) << times;
    EXPECT_EQ(monitor_.last_seen->frame, *lost + 1) << "they are there now, not before";
  }
}

TEST_F(Loss, TheRightDistanceIsKept) { EXPECT_FALSE(lost_in(1, {{6, 0.5, 1.2}})); }

}  // namespace
}  // namespace walktrack
