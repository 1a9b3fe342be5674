#include "jobs/track/report/recording_constants.h"

#include <gtest/gtest.h>

#include "observation/keypoints/keypoint_errors.h"

namespace walktrack {
namespace {

Scene scene_with(size_t cameras) {
  Scene scene;
  scene.cameras.resize(cameras);
  for (size_t c = 0; c < cameras; ++c) scene.cameras[c].name = "cam" + std::to_string(c);
  return scene;
}

TEST(RecordingConstants, NoneThatTheSceneStates) {
  EXPECT_TRUE(recording_constants({scene_with(2), 30, 1.2, {}, {}, {}}).empty());
}

TEST(RecordingConstants, OneCameraSeesEverythingInProportionToTheHeight) {
  const auto one =
      recording_constants({scene_with(1), 30, 1.2, {.stature = Stature{1.70, 0.034}}, {}, {}});
  ASSERT_EQ(one.size(), 1u);
  EXPECT_EQ(one[0].name, "height_m");
  EXPECT_EQ(one[0].value, 1.70);
  EXPECT_EQ(one[0].sd, 0.034);
  EXPECT_NE(one[0].effect.find("2.0 %"), std::string::npos) << one[0].effect;
  EXPECT_NE(one[0].effect.find("0.02 m/s"), std::string::npos) << one[0].effect;
  const auto two =
      recording_constants({scene_with(2), 30, 1.2, {.stature = Stature{1.70, 0.034}}, {}, {}});
  EXPECT_NE(two[0].effect.find("18 mm at the hips"), std::string::npos) << two[0].effect;
}

TEST(RecordingConstants, AGirthIsStatedInPercentOfAUsualOne) {
  const auto found = recording_constants({scene_with(1), 30, 1.2, {.girth = 1.28}, {}, {}});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].name, "girth_percent");
  EXPECT_NEAR(found[0].value, 128, 1e-9);
  EXPECT_NEAR(found[0].sd, 6, 1e-9);
}

TEST(RecordingConstants, ATrunkIsStatedInMetres) {
  const auto found = recording_constants({scene_with(1), 30, 1.2, {.trunk = 0.44}, {}, {}});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].name, "trunk_m");
  EXPECT_EQ(found[0].value, 0.44);
}

TEST(RecordingConstants, ALagIsStatedInSecondsAndByWhatItWouldHaveDone) {
  const auto found = recording_constants({scene_with(2), 60, 1.2, {}, FoundLag{1, 6, 0.5}, {}});
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].name, "lag_s_cam1");
  EXPECT_NEAR(found[0].value, 0.1, 1e-12);
  EXPECT_NEAR(found[0].sd, 0.5 / 60, 1e-12);
  EXPECT_NE(found[0].effect.find("120 mm apart; 10 mm"), std::string::npos) << found[0].effect;
}

// Points that are seen ahead of the hips by a share of the height, by cameras of which one has seen
// three times as much.
TEST(RecordingConstants, OffsetsOfTheCamerasCountByTheirInformation) {
  std::array<KeypointTerm::State, 3> cameras;
  const auto hip = static_cast<size_t>(PointKind::kHip);
  const std::array<double, 3> seen{1e6, 3e6, 1e9}, offset{0.01, 0.02, 0.5};
  for (size_t c = 0; c < cameras.size(); ++c) {
    cameras[c].errors = initial_errors();
    cameras[c].errors.information[hip] = {seen[c], 0, seen[c]};
    cameras[c].errors.pull[hip] = {seen[c] * offset[c], 0};
    cameras[c].use.matched = c < 2 ? 10 : 0;  // the last one saw somebody else
  }
  const Scene scene = scene_with(3);
  const auto found = recording_constants({scene, 30, 1.2, {}, {}, cameras});
  ASSERT_EQ(found.size(), 6u);
  EXPECT_EQ(found[0].name, "hip_offset_forward_m");
  EXPECT_NEAR(found[0].value, 0.0175 * scene.subject.height, 1e-4);
  EXPECT_NEAR(found[0].sd, scene.subject.height / std::sqrt(4e6), 1e-5);
  EXPECT_NE(found[0].effect.find("31 mm forwards"), std::string::npos) << found[0].effect;
  EXPECT_EQ(found[1].name, "hip_offset_up_m");
  EXPECT_EQ(found[5].name, "ankle_offset_up_m");
}

}  // namespace
}  // namespace walktrack
