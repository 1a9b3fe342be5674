#include "tracker/moves/mirror_legs.h"

#include <gtest/gtest.h>

#include "body/kinematics.h"
#include "fixture.h"
#include "tests/tracker/frame_time.h"
#include "tracker/modes/stride_modes.h"

namespace walktrack {
namespace {

class MirroredLegs : public testing::TestWithParam<MotionKind> {
 protected:
  Walking walking{GetParam()};
  MotionContext context = walking.context(kDt);
  const Body& body = walking.model.body;
  std::vector<WalkerParticle> set = walkers_on_their_way(context, 30);

  WalkerParticle mirrored(WalkerParticle particle) const {
    mirror_legs(context, particle);
    return particle;
  }
  JointPositions joints(const Pose& pose) const { return forward_kinematics(body, pose).joints; }
};

// To first order in the reach, and therefore on average; from the side the image is the same.
TEST_P(MirroredLegs, PutTheOtherFootWhereAFootWas) {
  double pelvis = 0, ankles = 0, knees = 0;  // m, by which they differ
  for (const WalkerParticle& particle : set) {
    const JointPositions before = joints(particle.pose), after = joints(mirrored(particle).pose);
    pelvis += (after[Joint::kPelvis] - before[Joint::kPelvis]).norm();
    for (const Side side : {Side::kLeft, Side::kRight}) {
      ankles += 0.5 * (after[ankle(side)] - before[ankle(other(side))]).norm();
      knees += 0.5 * (after[knee(side)] - before[knee(other(side))]).norm();
    }
  }
  const double count = static_cast<double>(set.size());
  EXPECT_LT(pelvis / count, 0.03);
  EXPECT_LT(ankles / count, 0.05);
  EXPECT_NEAR(knees / count, 0.5 * body.lengths.hip_width, 0.04) << "half way to the hip";
}

TEST_P(MirroredLegs, AreHalfAStrideAway) {
  for (const WalkerParticle& particle : set)
    EXPECT_NEAR(std::remainder(stride_phase(mirrored(particle)) - stride_phase(particle), 1.0),
                stride_phase(particle) < 0.5 ? 0.5 : -0.5, 1e-12);
}

TEST_P(MirroredLegs, AreAsBeforeWhenMirroredAgain) {
  for (const WalkerParticle& particle : set) {
    const WalkerParticle again = mirrored(mirrored(particle));
    EXPECT_EQ(again.stance, particle.stance);
    EXPECT_EQ(again.walker.q, particle.walker.q) << "the plane knows no sides";
    for (size_t k = 0; k < kResidualCount; ++k) {
      EXPECT_NEAR(again.residual[k], particle.residual[k], 1e-12) << k;
      EXPECT_NEAR(again.residual_before[k], particle.residual_before[k], 1e-12) << k;
    }
    EXPECT_LT((again.pose.root - particle.pose.root).norm(), 1e-9);
    EXPECT_NEAR(again.pose_before.legs[0].hip_abduction, particle.pose_before.legs[0].hip_abduction,
                1e-12);
  }
}

// Each leg continues with the motion of the other one.
TEST_P(MirroredLegs, ContinueTheirMotion) {
  const auto rate = [](const WalkerParticle& p, int k) {
    return p.residual[size_t(k)] - p.residual_before[size_t(k)];
  };
  for (const WalkerParticle& particle : set) {
    const WalkerParticle other_way = mirrored(particle);
    for (const int left : {kRotation, kAnkle, kThigh, kShank}) {
      EXPECT_NEAR(rate(other_way, left), rate(particle, left + 1), 1e-12);
      EXPECT_NEAR(rate(other_way, left + 1), rate(particle, left), 1e-12);
    }
    EXPECT_NEAR(rate(other_way, kAbduction), -rate(particle, kAbductionRight), 1e-12);
    const Pose &was = particle.pose_before, &is = other_way.pose_before;
    EXPECT_EQ(is.root, was.root);
    EXPECT_EQ(is.legs[0].hip_flexion, was.legs[1].hip_flexion);
    EXPECT_EQ(is.legs[1].knee_flexion, was.legs[0].knee_flexion);
  }
}

// Walkers continue to walk from there.
TEST_P(MirroredLegs, WalkOn) {
  int alive = 0;
  for (size_t i = 0; i < set.size(); ++i) {
    WalkerParticle particle = mirrored(set[i]);
    const Pose start = particle.pose;
    Rng rng(9, Purpose::kTorque, 0, static_cast<uint32_t>(i));
    Outcome outcome = Outcome::kAlive;
    for (int frame = 0; frame < 10 && outcome == Outcome::kAlive; ++frame)
      outcome = propagate(context, particle, rng);
    if (outcome != Outcome::kAlive) continue;
    ++alive;
    EXPECT_NEAR((particle.pose.root - start.root).head<2>().norm(), 1.3 * 10 * kDt, 0.35);
  }
  EXPECT_GT(alive, 20);
}

TEST_P(MirroredLegs, OfARecordAreThoseOfItsParticles) {
  const std::vector<double> weights(set.size(), 1.0 / double(set.size()));
  FrameRecord record;
  record.estimate = estimate_frame(walking.model, set, weights, kDt, 1);
  record.modes = stride_modes(set, weights);
  mirror_legs(body, record);
  for (WalkerParticle& particle : set) mirror_legs(context, particle);
  const FrameEstimate after = estimate_frame(walking.model, set, weights, kDt, 1);
  for (int i = 0; i < kJointAngleCount; ++i) {
    const Spread &is = record.estimate.angles[size_t(i)], &wanted = after.angles[size_t(i)];
    EXPECT_NEAR(is.mean, wanted.mean, 0.02) << i;
    EXPECT_NEAR(is.p05, wanted.p05, 0.06) << i;
    EXPECT_NEAR(is.p95, wanted.p95, 0.06) << i;
  }
  for (size_t j = 0; j < size_t(kJointCountWithoutArms); ++j)
    EXPECT_LT((record.estimate.joints.at[j] - after.joints.at[j]).norm(), 0.12) << j;
  EXPECT_NEAR(record.estimate.left_stance, after.left_stance, 1e-12);
  const StrideModes modes = stride_modes(set, weights);
  EXPECT_NEAR(std::remainder(record.modes.phase - modes.phase, 1.0), 0, 1e-9);
}

// What is explained later decides: half a stride is a switch, a quarter may be one.
TEST_P(MirroredLegs, OfRecordsBeforeASwitchAreMirrored) {
  const std::vector<double> weights(set.size(), 1.0 / double(set.size()));
  FrameRecord record;
  record.tracked = true;
  record.estimate = estimate_frame(walking.model, set, weights, kDt, 1);
  record.modes.phase = 0.2;
  const double knee = record.estimate.pose.legs[0].knee_flexion;
  ASSERT_NE(knee, record.estimate.pose.legs[1].knee_flexion);
  const auto after = [&](double phase) {
    std::vector<FrameRecord> records(3, record);
    records.back().modes.phase = phase;
    const bool doubt = relabel_before_switch(walking.model.body, records);
    EXPECT_EQ(records.back().estimate.pose.legs[0].knee_flexion, knee) << phase;
    EXPECT_EQ(records[0].modes.phase, records[1].modes.phase);
    return std::pair(doubt, records[0].modes.phase == record.modes.phase
                                ? records[0].estimate.pose.legs[0].knee_flexion == knee
                                : records[0].estimate.pose.legs[1].knee_flexion != knee);
  };
  using Outcome = std::pair<bool, bool>;  // doubtful, unchanged
  EXPECT_EQ(after(0.24), Outcome(false, true));
  EXPECT_EQ(after(0.50), Outcome(true, true));
  EXPECT_EQ(after(0.60), Outcome(true, false));
  EXPECT_EQ(after(0.79), Outcome(true, false));
  EXPECT_EQ(after(0.93), Outcome(true, true));
  record.modes.standing = 1;
  EXPECT_EQ(after(0.79), Outcome(false, true)) << "who stands has no phase";
  record.modes.standing = 0;
  std::vector<FrameRecord> stood(4, record);
  stood[1].modes.standing = 1;
  stood[3].modes.phase = 0.7;
  EXPECT_TRUE(relabel_before_switch(walking.model.body, stood));
  for (const size_t i : {0u, 1u, 3u})
    EXPECT_EQ(stood[i].estimate.pose.legs[0].knee_flexion, knee) << i;
  EXPECT_NE(stood[2].estimate.pose.legs[0].knee_flexion, knee) << "as far back as they walk";
  std::vector<FrameRecord> one(1, record);
  EXPECT_FALSE(relabel_before_switch(walking.model.body, one));
}

TEST_P(MirroredLegs, OfAFilterAreThoseOfItsParticles) {
  WalkerFilter filter({}, 3, 1);
  filter.start(set);
  mirror_legs(context, filter);
  const auto& states = filter.particles().states;
  ASSERT_EQ(states.size(), set.size());
  for (size_t i = 0; i < set.size(); ++i) {
    const Pose wanted = mirrored(set[i]).pose;
    EXPECT_EQ(states[i].stance, other(set[i].stance));
    EXPECT_EQ(states[i].pose.root, wanted.root);
    EXPECT_EQ(states[i].pose.legs[0].hip_abduction, wanted.legs[0].hip_abduction);
  }
}

INSTANTIATE_TEST_SUITE_P(Models, MirroredLegs,
                         testing::Values(MotionKind::kKneed, MotionKind::kAnthropomorphic,
                                         MotionKind::kMarkov));

}  // namespace
}  // namespace walktrack
