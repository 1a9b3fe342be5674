#include "tracker/figure_fit.h"

#include <cmath>

#include <gtest/gtest.h>

#include "fixture.h"
#include "made_evidence.h"
#include "tests/observation/scenes.h"

namespace walktrack {
namespace {

class Fit : public testing::Test {
 protected:
  // A person in the pose of a stride, in front of two cameras.
  Fit() {
    for (const Eigen::Vector3d& from : {Eigen::Vector3d(0, -4, 1), Eigen::Vector3d(3, -3, 1.5)}) {
      scene.cameras.push_back(camera_at(from, {0, 0, 0.9}, 300, kEvidenceWidth, kEvidenceHeight));
      evidence.push_back(evidence_of(scene.cameras.back(), scene.model.body, striding()));
    }
  }
  TrackerScene scene = unseen(test_model(), 1.0 / 30);
  SceneEvidence evidence;
};

TEST_F(Fit, NothingIsBetterThanThePersonsOwnPose) {
  const FigureFit fit = figure_fit(scene, evidence, striding());
  EXPECT_EQ(fit.overlap, (std::vector<double>{1, 1}));
  EXPECT_EQ(fit.seen, (std::vector<double>{1, 1}));
  EXPECT_EQ(fit.better_beside, 0);
}

TEST_F(Fit, AFigureBesideThePersonIsSeenInBothMeasures) {
  double overlap_before = 1, beside_before = 0;
  for (const double aside : {0.1, 0.2, 0.4}) {
    Pose pose = striding();
    pose.root.x() += aside;
    const FigureFit fit = figure_fit(scene, evidence, pose);
    EXPECT_LT(fit.overlap[0], overlap_before) << aside;
    EXPECT_GE(fit.better_beside, beside_before) << aside;
    overlap_before = fit.overlap[0];
    beside_before = fit.better_beside;
  }
  EXPECT_LT(overlap_before, 0.4);
  EXPECT_GT(beside_before, 100);
}

TEST_F(Fit, AFigureThatFacesElsewhereIsSeen) {
  Pose pose = striding();
  pose.heading = rad_from_deg(30);
  EXPECT_GT(figure_fit(scene, evidence, pose).better_beside, 0.5);
}

// As many nats a picture before one camera as before two of the same kind, and a ninth of them
// where outlines count for a ninth.
TEST_F(Fit, EvidenceBesideIsThatOfAPicture) {
  Pose pose = striding();
  pose.root.x() += 0.1;
  const auto beside = [&] { return figure_fit(scene, evidence, pose).better_beside; };
  scene.cameras[1] = scene.cameras[0];
  evidence[1] = evidence[0];
  const double two = beside();
  EXPECT_GT(two, 1);
  scene.observation.outline_share = 1.0 / 9;
  EXPECT_NEAR(beside(), two / 9, 1e-9 * two);
  scene.observation.outline_share = 1;
  scene.cameras.pop_back();
  evidence.pop_back();
  EXPECT_NEAR(beside(), two, 1e-9 * two);
}

// The subject has arms, which hang and swing; the figure has none.
TEST_F(Fit, ArmsThatTheFigureLacksAreNotMissed) {
  BodyGroups groups = scene.model.body.groups;
  groups.arms = true;
  const Body arms = make_body(scene.model.body.subject, groups);
  for (const double swing : {-25.0, -12.0, 0.0, 12.0, 25.0}) {
    Pose pose = striding();
    pose.arms[0] = {rad_from_deg(swing), 0, rad_from_deg(15)};
    pose.arms[1] = {rad_from_deg(-swing), 0, rad_from_deg(15)};
    for (size_t c = 0; c < 2; ++c) evidence[c] = evidence_of(scene.cameras[c], arms, pose);
    for (const double overlap : figure_fit(scene, evidence, striding()).overlap)
      EXPECT_GT(overlap, 0.9) << swing;
  }
}

TEST_F(Fit, ACameraThatSeesNothingSaysNothing) {
  evidence[1] = CameraEvidence{};
  const FigureFit fit = figure_fit(scene, evidence, striding());
  EXPECT_EQ(fit.overlap[0], 1);
  EXPECT_TRUE(std::isnan(fit.overlap[1]));
  EXPECT_EQ(fit.seen[1], 0);
  evidence[0] = CameraEvidence{};
  EXPECT_EQ(figure_fit(scene, evidence, striding()).better_beside, 0);
  EXPECT_TRUE(figure_fit(unseen(test_model(), 0.1), {}, striding()).overlap.empty());
}

}  // namespace
}  // namespace walktrack
