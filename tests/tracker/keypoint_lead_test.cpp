#include "tracker/start/keypoint_lead.h"

#include <gtest/gtest.h>

#include "fixture.h"
#include "made_evidence.h"
#include "tests/observation/scenes.h"
#include "tracker/tracked_subject.h"

namespace walktrack {
namespace {

// A person wider than the figure by a factor, in front of one camera, with a detector's point.
class Lead : public testing::Test {
 protected:
  Lead() {
    scene.cameras = {camera_at({0, -4, 1}, {0, 0, 0.9}, 300, kEvidenceWidth, kEvidenceHeight)};
    scene.observation.keypoints.enabled = TermSetting::kOn;
  }
  void show(double wider) {
    Body person = scene.model.body;
    for (Part& part : person.parts)
      for (CrossSection* section : {&part.at_lower, &part.at_upper})
        *section = {wider * section->lateral, wider * section->forward};
    window.assign(2, {evidence_of(scene.cameras[0], person, striding())});
    window[1][0].keypoints.people.emplace_back();
    records.assign(2, {});
    for (FrameRecord& record : records) {
      record.tracked = true;
      record.estimate.pose = striding();
    }
  }
  TrackerScene scene = unseen(test_model(), 1.0 / 30);
  std::deque<SceneEvidence> window;
  std::vector<FrameRecord> records;
};

TEST_F(Lead, AFigureIsTooThinForSomebodyMuchWider) {
  show(1);
  EXPECT_FALSE(figure_is_too_thin(scene, window, records));
  show(1.1);
  EXPECT_FALSE(figure_is_too_thin(scene, window, records));
  show(2);
  EXPECT_TRUE(figure_is_too_thin(scene, window, records));
  show(0.5);
  EXPECT_FALSE(figure_is_too_thin(scene, window, records)) << "too thick";
}

TEST_F(Lead, NobodyLeadsWithoutKeypointsOrATrack) {
  show(2);
  for (FrameRecord& record : records) record.tracked = false;
  EXPECT_FALSE(figure_is_too_thin(scene, window, records));
  show(2);
  window[1][0].keypoints.people.clear();
  EXPECT_FALSE(figure_is_too_thin(scene, window, records));
  EXPECT_FALSE(figure_is_too_thin(scene, {}, {}));
}

TEST_F(Lead, OnlyOneCameraThatUsesKeypointsAndWhomNobodyHasToldOtherwise) {
  EXPECT_TRUE(may_lead(scene));
  TrackerScene other = scene;
  other.observation.outline_share = weights_for(1, true).outline_share;
  EXPECT_TRUE(may_lead(other)) << "by default outlines already count for less";
  let_keypoints_lead(other.observation);
  EXPECT_FALSE(may_lead(other)) << "they lead already";
  other = scene;
  other.observation.keypoints.lead = TermSetting::kOff;
  EXPECT_FALSE(may_lead(other));
  other = scene;
  other.observation.keypoints.enabled = TermSetting::kOff;
  EXPECT_FALSE(may_lead(other));
  other = scene;
  other.cameras.push_back(other.cameras[0]);
  EXPECT_FALSE(may_lead(other));
}

TEST_F(Lead, OutlinesThenCountForANinth) {
  show(1);
  const PosedBody body(scene.model.body, striding());
  const auto outlines = [&] {
    return SilhouetteTerm::log_likelihood(scene.observation, window[0][0], scene.cameras[0], body,
                                          nullptr);
  };
  const double before = outlines();
  EXPECT_GT(before, 0);
  let_keypoints_lead(scene.observation);
  EXPECT_NEAR(outlines(), before / 9, 1e-9 * before);
  EXPECT_EQ(scene.observation.keypoints.weight, 1);
  scene.observation.keypoints.weight = 3;
  let_keypoints_lead(scene.observation);
  EXPECT_EQ(scene.observation.keypoints.weight, 3) << "more than that stays";
}

// A walk of 6 nats a frame by outlines has less than one by a ninth of them.
TEST_F(Lead, AWalkIsFoundByLessEvidence) {
  const GaitPrior prior = load_gait_prior();
  TrackedSubject subject(scene, prior, TrackerConfig{}, 1, 1);
  const DetectorConfig& detector = subject.config.detector;
  EXPECT_EQ(detector.least_score, DetectorConfig{}.least_score);
  subject.let_keypoints_lead();
  EXPECT_TRUE(subject.keypoints_lead());
  EXPECT_EQ(detector.least_score, DetectorConfig{}.least_points_score);
}

TEST_F(Lead, OutlinesThatCountInPartHaveLessEvidence) {
  scene.observation.outline_share = 0.25;
  EXPECT_EQ(detector_for(scene, {.least_score = 8}).least_score, 2);
  scene.pictures = false;
  EXPECT_EQ(detector_for(scene, {.least_points_score = 1.5}).least_score, 1.5);
}

}  // namespace
}  // namespace walktrack
