#include "tracker/frame_likelihood.h"

#include <cmath>

#include <gtest/gtest.h>

#include "fixture.h"
#include "made_evidence.h"
#include "tests/observation/picture_terms.h"
#include "tests/observation/scenes.h"
#include "tracker/walk_prior.h"

namespace walktrack {
namespace {

struct Seen : testing::Test {
  const Walking walking{};
  const MotionContext context = walking.context(1.0 / 30);
  TrackerScene scene = unseen(walking.model, 1.0 / 30);
  SceneEvidence evidence;
  std::vector<WalkerParticle> particles = walkers_on_their_way(context, 1);

  void add(double x, double nats, bool flow) {
    scene.cameras.push_back(camera_at({x, -4, 1}, {x, 0, 1}, 300, kEvidenceWidth, kEvidenceHeight));
    evidence.push_back(made_evidence(nats, flow));
  }

  // Of the distribution of knees and ankles before one camera, a third of what it says in .1 s.
  double beside_the_pelvis(const WalkerParticle& particle) const {
    if (evidence.size() != 1) return 0;
    const Body& body = walking.model.body;
    const double ahead = particle.pose.heading + std::atan2(particle.way.y(), particle.way.x());
    return -0.5 / 3 *
           legs_aside(forward_kinematics(body, particle.pose).joints, body.subject.height,
                      {std::cos(ahead), std::sin(ahead)})
               .squaredNorm();
  }

  // Computed independently: camera by camera, all terms at once.
  double whole(bool with_motion) const {
    const auto capsules = [&](size_t c, const Pose& pose) {
      const Body& body = walking.model.body;
      return project_parts(scene.cameras[c], pose_parts(body, forward_kinematics(body, pose)));
    };
    double sum = beside_the_pelvis(particles[0]);
    for (size_t c = 0; c < evidence.size(); ++c) {
      const CapsuleList before = capsules(c, particles[0].pose_before);
      sum += particle_log_likelihood(scene.observation, evidence[c], capsules(c, particles[0].pose),
                                     with_motion ? &before : nullptr);
    }
    return sum;
  }

  double by_stages(bool with_motion) const {
    const FrameLikelihood likelihood(scene, evidence, with_motion);
    const auto account = likelihood(particles[0]);
    double sum = 0;
    for (int stage = 0; stage < likelihood.stages(); ++stage) sum += account(stage);
    return sum;
  }
};

TEST_F(Seen, StagesAddUpToAllCamerasAndTerms) {
  for (int cameras = 1; cameras <= 5; ++cameras) {
    add(0.3 * cameras, 0.5 * cameras, cameras != 2);
    for (const bool with_motion : {false, true}) {
      ASSERT_NE(whole(with_motion), 0);
      EXPECT_NEAR(by_stages(with_motion), whole(with_motion), 1e-9 * std::abs(whole(with_motion)));
    }
    EXPECT_NE(whole(true), whole(false));
  }
}

TEST_F(Seen, KneesAndAnklesOfPeopleWhoWalkAreBelowTheirHips) {
  add(0, 0, false);
  WalkerParticle& particle = particles[0];
  particle.way = {1.3, 0.2};
  particle.pose.heading = 2;
  EXPECT_NEAR(by_stages(false), beside_the_pelvis(particle), 1e-9);
  const double usual = by_stages(false);
  particle.pose.legs[0].hip_abduction += 0.3;
  EXPECT_LT(by_stages(false), usual - 1);
  EXPECT_NEAR(by_stages(false), beside_the_pelvis(particle), 1e-9);
  particle.way *= 0.2;  // who stands may put their feet anywhere
  EXPECT_NEAR(by_stages(false), 0, 1e-9);
  particle.way *= 5;
  add(1, 0, false);  // another camera sees where they are
  EXPECT_NEAR(by_stages(false), 0, 1e-9);
}

TEST_F(Seen, OnlyWhatTheSceneHasIsAStage) {
  const auto stages = [&](bool with_motion) {
    return FrameLikelihood(scene, evidence, with_motion).stages();
  };
  EXPECT_EQ(stages(true), 1);  // no camera: only the height of the hips counts
  add(0, 1, false);
  EXPECT_EQ(stages(true), 1);
  evidence[0] = made_evidence(1, true);
  EXPECT_EQ(stages(true), 2);
  EXPECT_EQ(stages(false), 1);
  add(1, 1, false);
  EXPECT_EQ(stages(false), 2);
  EXPECT_EQ(stages(true), 2);
}

}  // namespace
}  // namespace walktrack
