// Laws of inverse dynamics, on motions that are known exactly.
#include "kinetics/kinetics.h"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "core/conventions.h"
#include "kinetics/linked_body.h"
#include "sample_motions.h"

namespace walktrack {
namespace {

using Eigen::Vector3d;

constexpr KineticsConfig kExact{.cutoff_hz = 0};  // generated motions need no smoothing
const Subject kSubject{};
const Vector3d kGravity(0, 0, -kStandardGravity);
const double kWeight = kSubject.mass * kStandardGravity;
const std::vector<FootContact> kBothFeet{{Side::kLeft, -2, 3}, {Side::kRight, -1, 2}};
const std::vector<FootContact> kLeftFoot{{Side::kLeft, -1, 9}};

TEST(Kinetics, AStillStanceCarriesTheWeightBetweenTheFeet) {
  const Motion motion = motion_by([](double) { return joints_of(standing()); });
  const Kinetics k = kinetics_of(motion, kBothFeet, kSubject, kGravity, kExact);
  const KineticsFrame& frame = k.frames[50];
  EXPECT_TRUE(frame.ground.force.isApprox(Vector3d(0, 0, kWeight), 1e-9));
  EXPECT_NEAR(frame.feet[0].force.z() + frame.feet[1].force.z(), kWeight, 1e-6);
  EXPECT_NEAR(frame.unexplained_moment, 0, 1e-6);
  // The centre of pressure is below the centre of mass.
  const Eigen::Vector2d centre(-frame.ground.moment.y() / kWeight,
                               frame.ground.moment.x() / kWeight);
  EXPECT_TRUE(centre.isApprox(frame.com.head<2>(), 1e-9));
  EXPECT_EQ(k.totals.positive_work, 0);
}

TEST(Kinetics, AFallingBodyNeedsNoForces) {
  const Motion motion = motion_by([](double t) {
    Pose pose = standing();
    pose.root += Vector3d(1.5 * t, 0.2 * t, 1 - 0.5 * kStandardGravity * t * t);
    return joints_of(pose);
  });
  const KineticsFrame frame = kinetics_of(motion, kLeftFoot, kSubject, kGravity, kExact).frames[50];
  EXPECT_LT(frame.ground.force.norm(), 1e-6 * kWeight);
  EXPECT_LT(frame.ground.moment.norm(), 1e-6 * kWeight);
  EXPECT_NEAR(frame.legs[0].hip_flexion, 0, 1e-4);
}

TEST(Kinetics, ForcesAreMassTimesAccelerationLessGravity) {
  const Motion motion = motion_by([](double t) { return joints_of(lively(t), true); });
  const Kinetics k = kinetics_of(motion, kBothFeet, kSubject, kGravity, kExact);
  for (const size_t i : {20u, 50u, 80u}) {
    const Vector3d acceleration =
        (k.frames[i + 1].com - 2 * k.frames[i].com + k.frames[i - 1].com) * kSampleRate *
        kSampleRate;
    const Vector3d force = kSubject.mass * (acceleration - kGravity);
    // Second differences of a motion of up to 10 rad/s are accurate to (10 dt)^2 / 12 of a few
    // m/s^2.
    EXPECT_LT((k.frames[i].ground.force - force).norm(), 2);
  }
}

// The moment of the ground's and gravity's forces about any fixed point is the rate of change of
// the angular momentum about it.
TEST(Kinetics, MomentsBalanceAboutAnyPoint) {
  const Motion motion = motion_by([](double t) { return joints_of(lively(t), true); });
  const Kinetics k = kinetics_of(motion, kBothFeet, kSubject, kGravity, kExact);
  const LinkedBody body = linked_body(kSubject, motion.joints);
  const auto states = linked_states(body, motion.joints, 1 / kSampleRate);
  const auto about = [&](size_t i, const Vector3d& point) {
    const BodyMomentum m = body_momentum(body.tree, states[i].q, states[i].u);
    return Vector3d(m.angular + (m.com - point).cross(m.linear));
  };
  for (const Vector3d& point : {Vector3d(0, 0, 0), Vector3d(3, -2, 1), Vector3d(-1, 0.5, 0.2)}) {
    for (const size_t i : {20u, 60u}) {
      const KineticsFrame& frame = k.frames[i];
      const Vector3d rate = (about(i + 1, point) - about(i - 1, point)) * kSampleRate / 2;
      const Vector3d moment = frame.ground.moment - point.cross(frame.ground.force) +
                              (frame.com - point).cross(kSubject.mass * kGravity);
      EXPECT_LT((moment - rate).norm(), 2) << "about " << point.transpose();
    }
  }
}

// Shank and foot of a still, lifted leg swing about the knee: a physical pendulum,
// knee moment = I theta'' + m g l sin theta, both from the tree's own mass properties.
TEST(Kinetics, ASwingingShankIsAPendulum) {
  constexpr double kAmplitude = 0.3, kOmega = 4;
  const auto flexion = [](double t) { return 0.8 + kAmplitude * std::sin(kOmega * t); };
  const Motion motion = motion_by([&](double t) {
    Pose pose = standing();
    pose.legs[1].hip_flexion = 0.5;
    pose.legs[1].knee_flexion = flexion(t);
    return joints_of(pose);
  });
  const Kinetics k = kinetics_of(motion, kLeftFoot, kSubject, kGravity, kExact);
  const LinkedBody body = linked_body(kSubject, motion.joints);
  const auto states = linked_states(body, motion.joints, 1 / kSampleRate);
  for (const size_t i : {15u, 40u, 77u}) {
    const double t = motion.time[i];
    const auto parts = part_motions(body.tree, states[i].q, states[i].u, states[i].u_dot);
    const Vector3d knee_place = motion.joints[i][Joint::kRightKnee];
    double inertia = 0, moment = 0;
    for (const Segment segment : {Segment::kRightShank, Segment::kRightFoot}) {
      const size_t part = body.index(segment);
      const MassProperties& mass = body.tree.parts()[part].mass;
      const Vector3d arm = point_position(parts[part], mass.com) - knee_place;
      const Vector3d left = parts[part].rotation.transpose() * Vector3d::UnitY();
      inertia +=
          left.dot(mass.inertia * left) + mass.mass * (arm.x() * arm.x() + arm.z() * arm.z());
      // Flexion rotates about +y and moves a hanging shank backwards: to hold it against gravity
      // the knee needs m g times its horizontal distance.
      moment += mass.mass * kStandardGravity * -arm.x();
    }
    const double acceleration = -kAmplitude * kOmega * kOmega * std::sin(kOmega * t);
    EXPECT_NEAR(k.frames[i].legs[1].knee_flexion, inertia * acceleration + moment, 0.02);
    const double rate = kAmplitude * kOmega * std::cos(kOmega * t);
    EXPECT_NEAR(k.frames[i].legs[1].knee_power, k.frames[i].legs[1].knee_flexion * rate, 0.03);
  }
}

TEST(Kinetics, MirroredMotionsHaveMirroredLoads) {
  const auto mirrored_joints = [](JointPositions joints) {
    for (Vector3d& point : joints.at) point.y() *= -1;
    for (const auto& of : {hip, knee, ankle, toe})
      std::swap(joints[of(Side::kLeft)], joints[of(Side::kRight)]);
    return joints;
  };
  const Motion motion = motion_by([](double t) { return joints_of(lively(t)); });
  const Motion mirror = motion_by([&](double t) { return mirrored_joints(joints_of(lively(t))); });
  const std::vector<FootContact> contacts{{Side::kLeft, -1, 0.6}, {Side::kRight, 0.4, 2}};
  const std::vector<FootContact> swapped{{Side::kRight, -1, 0.6}, {Side::kLeft, 0.4, 2}};
  const Kinetics a = kinetics_of(motion, contacts, kSubject, kGravity, {});
  const Kinetics b = kinetics_of(mirror, swapped, kSubject, kGravity, {});
  for (const size_t i : {20u, 50u, 80u}) {
    const KineticsFrame &one = a.frames[i], &two = b.frames[i];
    for (size_t side = 0; side < 2; ++side) {
      const LegLoads &p = one.legs[side], &q = two.legs[1 - side];
      EXPECT_NEAR(p.hip_flexion, q.hip_flexion, 1e-6);
      EXPECT_NEAR(p.hip_abduction, q.hip_abduction, 1e-6);
      EXPECT_NEAR(p.knee_flexion, q.knee_flexion, 1e-6);
      EXPECT_NEAR(p.ankle_power, q.ankle_power, 1e-6);
      EXPECT_NEAR(one.feet[side].force.y(), -two.feet[1 - side].force.y(), 1e-6);
    }
  }
}

TEST(Kinetics, UnknownJointsAndShortSpansAreLeftOut) {
  Motion motion = motion_by([](double) { return joints_of(standing()); }, 40);
  for (const size_t i : {20u, 25u}) motion.joints[i] = unknown_joints();
  const Kinetics k = kinetics_of(motion, kBothFeet, kSubject, kGravity, {});
  ASSERT_EQ(k.frames.size(), 40u);
  EXPECT_TRUE(k.frames[19].known);
  EXPECT_FALSE(k.frames[20].known);
  EXPECT_FALSE(k.frames[22].known);  // four rows between two gaps
  EXPECT_TRUE(k.frames[26].known);
  EXPECT_TRUE(kinetics_of({}, {}, kSubject, kGravity, {}).frames.empty());
}

}  // namespace
}  // namespace walktrack
