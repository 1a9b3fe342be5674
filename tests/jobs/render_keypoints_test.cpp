#include "jobs/render/render_keypoints.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "io/keypoints/keypoint_file.h"
#include "synth/walk/made_walk.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

using enum KeypointName;

class RenderedKeypoints : public testing::Test {
 protected:
  RenderedKeypoints() {
    FilmedWalker walker;
    walker.motion = made_walk(make_body(Subject{}, {.head = true, .arms = true}), MadeWalk{});
    stage_ = make_stage(walker, {}, {});
  }
  DetectedPerson seen(const KeypointFaults& faults, uint32_t frame = 0, double time = 1) const {
    const DetectedPeople people =
        rendered_keypoints(stage_, stage_.cameras[0], faults, 1, 0, frame, time);
    return people.empty() ? DetectedPerson() : people.front();
  }
  double height_px() const {
    const JointPositions joints = joints_at(stage_.actors[0], 1);
    const auto& camera = stage_.cameras[0];
    const Eigen::Vector3d foot = 0.5 * (joints[Joint::kLeftAnkle] + joints[Joint::kRightAnkle]);
    return (*project(camera, joints[Joint::kHead]) - *project(camera, foot)).norm();
  }
  Stage stage_;
};

TEST_F(RenderedKeypoints, LieOnTheJoints) {
  const DetectedPerson person = seen({.noise = 0});
  const auto knee =
      project(stage_.cameras[0], joints_at(stage_.actors[0], 1)[Joint::kLeftKnee]).value();
  EXPECT_NEAR(static_cast<double>(person[kLeftKnee].x_px), knee.x(), 1e-3);
  EXPECT_NEAR(static_cast<double>(person[kLeftKnee].y_px), knee.y(), 1e-3);
  EXPECT_GT(person[kLeftWrist].confidence, 0.39f);
  EXPECT_EQ(person[kLeftHeel].confidence, 0);
}

// The errors of the knees in 2,000 frames have the standard deviation that is stated.
TEST_F(RenderedKeypoints, ErrAsStated) {
  const DetectedPerson truth = seen({.noise = 0});
  double sum = 0;
  constexpr uint32_t kFrames = 2000;
  for (uint32_t frame = 0; frame < kFrames; ++frame) {
    const Keypoint knee = seen({.noise = 0.02}, frame)[kLeftKnee];
    const double error = static_cast<double>(knee.x_px - truth[kLeftKnee].x_px);
    sum += error * error * static_cast<double>(knee.confidence);
  }
  const double expected = std::pow(0.02 * height_px(), 2);
  EXPECT_NEAR(sum / kFrames, expected, 5 * expected * std::sqrt(2.0 / kFrames));
}

TEST_F(RenderedKeypoints, AreBiasedUpwards) {
  const float up =
      seen({.noise = 0})[kLeftHip].y_px - seen({.noise = 0, .bias = 0.05})[kLeftHip].y_px;
  EXPECT_NEAR(static_cast<double>(up), 0.05 * height_px(), 1e-3);
}

TEST_F(RenderedKeypoints, SwapLegsAndNotArms) {
  const DetectedPerson right = seen({.noise = 0});
  const DetectedPerson swapped = seen({.noise = 0, .flipped = {{0.9, 1.1}}});
  EXPECT_EQ(swapped[kLeftKnee].x_px, right[kRightKnee].x_px);
  EXPECT_EQ(swapped[kLeftWrist].x_px, right[kLeftWrist].x_px);
  EXPECT_EQ(seen({.noise = 0, .flipped = {{1.1, 1.2}}})[kLeftKnee].x_px, right[kLeftKnee].x_px);
}

TEST_F(RenderedKeypoints, LeaveOutThatShareOfPoints) {
  int lost = 0;
  constexpr int kFrames = 1000;
  for (uint32_t frame = 0; frame < kFrames; ++frame)
    lost += seen({.dropout = 0.3}, frame)[kLeftKnee].confidence == 0;
  EXPECT_NEAR(lost / double{kFrames}, 0.3, 5 * std::sqrt(0.3 * 0.7 / kFrames));
}

TEST_F(RenderedKeypoints, MayShowNobody) {
  EXPECT_TRUE(
      rendered_keypoints(stage_, stage_.cameras[0], {.missing = {{0.5, 2}}}, 1, 0, 0, 1).empty());
}

// The files are read as they were written.
TEST_F(RenderedKeypoints, AreReadBack) {
  const TemporaryFolder folder;
  const DetectedPerson person = seen({.noise = 0.01, .dropout = 0.2});
  folder.write(openpose_file_name("side", 12), openpose_json({person}));
  const KeypointFrames frames = read_keypoints({.path = folder.path()});
  ASSERT_EQ(frames.people.at(12).size(), 1u);
  for (size_t k = 0; k < kKeypointCount; ++k) {
    EXPECT_NEAR(frames.people.at(12)[0].points[k].x_px, person.points[k].x_px, 0.006);
    EXPECT_EQ(frames.people.at(12)[0].points[k].confidence > 0, person.points[k].confidence > 0);
  }
}

}  // namespace
}  // namespace walktrack
