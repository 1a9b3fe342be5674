#include "jobs/track/input/next_frame.h"

#include <gtest/gtest.h>

#include "jobs/track/track_setup.h"

namespace walktrack {
namespace {

class NextFrameOfTheDemo : public testing::Test {
 protected:
  NextFrameOfTheDemo() {
    Config config;
    config.observation.background.enabled = false;  // no background to learn
    setup_ = set_up(scene_, config, video_.frame_rate(), {}, {});
    for (const Camera& camera : setup_.scene.cameras) {
      whole_.push_back(whole_image(camera, 0.01));
      part_.push_back(person_region(camera, {0, 0}, 1.75, 0.5));
    }
    evidence_.resize(setup_.observers.size());
  }

  const Scene scene_ = read_scene(WALKTRACK_SOURCE_DIR "/data/demo/scene.yaml");
  SceneVideo video_{scene_};
  TrackSetup setup_;
  std::vector<Region> whole_, part_;
  SceneEvidence evidence_;
};

TEST_F(NextFrameOfTheDemo, CanBePreparedAgainToLookElsewhere) {
  NextFrame next(scene_, video_, setup_.observers, setup_.detections);
  EXPECT_FALSE(next.fetched());
  next.fetch(part_, true, 2, 1);
  EXPECT_TRUE(next.fetched());
  next.prepare(whole_, false, 2, 1);
  next.complete(0, 2, evidence_);
  EXPECT_FALSE(next.fetched());
  for (size_t c = 0; c < evidence_.size(); ++c) {
    EXPECT_NE(part_[c].area.width(), whole_[c].area.width());
    EXPECT_EQ(evidence_[c].planes.area.width(), whole_[c].area.width());
  }
}

TEST_F(NextFrameOfTheDemo, IsNotThereAfterTheLast) {
  NextFrame next(scene_, video_, setup_.observers, setup_.detections);
  int frames = 0;
  for (next.fetch(part_, true, 1, 1); next.there(); next.fetch(part_, true, 1, 1), ++frames)
    next.complete(0, 1, evidence_);
  EXPECT_EQ(frames, video_.frame_count());
  EXPECT_TRUE(next.fetched());
}

}  // namespace
}  // namespace walktrack
