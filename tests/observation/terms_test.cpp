#include "observation/terms.h"

#include <set>

#include <gtest/gtest.h>

#include "tests/observation/picture_terms.h"
#include "tests/observation/scenes.h"
#include "tests/tracker/made_evidence.h"

namespace walktrack {
namespace {

TEST(Terms, HaveNamesAndSwitchesOfTheirOwn) {
  std::set<std::string_view> names;
  Terms::each([&]<typename Term>() { names.insert(Term::kName); });
  EXPECT_EQ(names.size(), Terms::kCount);
  std::set<std::string_view> keys;
  for (const TermSwitch& each : term_switches()) keys.insert(each.key);
  EXPECT_EQ(keys.size(), term_switches().size());
  EXPECT_TRUE(keys.contains("background") && keys.contains("foreground") && keys.contains("flow"));
}

TEST(Terms, SayNothingOfNothing) {
  const CameraEvidence nothing;
  Terms::each([&]<typename Term>() { EXPECT_FALSE(Term::says(nothing)) << Term::kName; });
  const Body body = make_body(Subject{}, {});
  EXPECT_EQ(still_log_likelihood({}, nothing, side_camera(), PosedBody(body, Pose{})), 0);
}

TEST(Terms, ThatAreOffCostNothing) {
  ObservationConfig off;
  off.background.enabled = off.foreground.enabled = false;
  off.flow.enabled = TermSetting::kOff;
  const TermWork work{1e4, 120, 1e3, 11, 4};
  Terms::each([&]<typename Term>() { EXPECT_TRUE(Term::cost(off, work).empty()) << Term::kName; });
  for (const TermSwitch& each : term_switches()) EXPECT_FALSE(each.on(off)) << each.key;
}

// The sum over the list of terms is the sum that is written out by hand.
TEST(Terms, AddUp) {
  CameraEvidence evidence = made_evidence(0.7, true);
  evidence.pixel_weight = 0.3;
  const Camera camera = camera_at({0, -4, 1}, {0, 0, 1}, 300, kEvidenceWidth, kEvidenceHeight);
  const Body body = make_body(Subject{}, {});
  Pose pose;
  pose.root = {0, 0, 0.95};
  const PosedBody now(body, pose);
  pose.root.x() -= 0.03;
  const PosedBody before(body, pose);
  double sum = 0;
  Terms::each([&]<typename Term>() {
    if constexpr (kWeighsParticles<Term>)
      if (Term::says(evidence))
        sum += Term::log_likelihood(ObservationConfig{}, evidence, camera, now, &before);
  });
  const CapsuleList capsules_before = project_parts(camera, before.parts);
  const double by_hand =
      particle_log_likelihood({}, evidence, project_parts(camera, now.parts), &capsules_before);
  EXPECT_NE(by_hand, 0);
  EXPECT_NEAR(sum, by_hand, 1e-12 * std::abs(by_hand));
}

// Arms have no effect, whether the body has them or not.
TEST(Terms, FlowAsksLegsAndFeetAlone) {
  const CameraEvidence evidence = made_evidence(0.7, true);
  const Camera camera = camera_at({0, -4, 1}, {0, 0, 1}, 300, kEvidenceWidth, kEvidenceHeight);
  Pose pose;
  pose.root = {0, 0, 0.95};
  Pose earlier = pose;
  earlier.root.x() -= 0.03;
  const auto said = [&](bool all) {
    const Body body = make_body(Subject{}, {.head = all, .arms = all});
    const PosedBody now(body, pose), before(body, earlier);
    return FlowTerm::log_likelihood({}, evidence, camera, now, &before);
  };
  EXPECT_NE(said(true), 0);
  EXPECT_EQ(said(true), said(false));
}

}  // namespace
}  // namespace walktrack
