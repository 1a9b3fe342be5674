#include "jobs/track/input/learned_background.h"

#include <algorithm>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "jobs/track/track_setup.h"
#include "tests/data_folders.h"
#include "tests/message_of.h"

namespace walktrack {
namespace {

using testing::HasSubstr;

// The demo, whose backgrounds are learned from its videos, with the people in them.
class LearnedBackgrounds : public testing::Test {
 protected:
  LearnedBackgrounds() {
    for (SceneCamera& camera : scene_.cameras) camera.background.clear();
    config_.observation.background.without_people = TermSetting::kOff;
    config_.threads = 2;
  }
  Scene scene_ = read_scene(kDemo / "scene.yaml");
  Config config_;
};

TEST_F(LearnedBackgrounds, AreThoseOfEachCamera) {
  std::vector<size_t> done;
  JobControl control;
  control.report = [&done](const Progress& progress) { done.push_back(progress.done); };
  const auto models = learned_backgrounds(scene_, config_, control);
  EXPECT_TRUE(std::ranges::is_sorted(done)) << "progress of more than one camera";
  ASSERT_EQ(models.size(), scene_.cameras.size());
  for (size_t c = 0; c < models.size(); ++c) {
    const SceneCamera& camera = scene_.cameras[c];
    const BackgroundModel alone =
        learned_background(camera, 0, config_, working_scale(scene_, camera.camera, config_), {});
    ASSERT_TRUE(models[c]);
    EXPECT_EQ(models[c]->luma, alone.luma) << c;
    EXPECT_EQ(models[c]->chroma_precision, alone.chroma_precision) << c;
  }
  scene_.cameras[1].video.clear();
  EXPECT_FALSE(learned_backgrounds(scene_, config_, {})[1]) << "a camera with keypoints only";
}

TEST_F(LearnedBackgrounds, TheErrorIsThatOfTheFirstCamera) {
  for (SceneCamera& camera : scene_.cameras) camera.background = camera.name + "_none.png";
  for (int i = 0; i < 5; ++i)
    EXPECT_THAT(message_of<InputError>([&] { learned_backgrounds(scene_, config_, {}); }),
                HasSubstr(scene_.cameras[0].name + "_none.png"));
}

}  // namespace
}  // namespace walktrack
