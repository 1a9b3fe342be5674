#include "tracker/smooth/trajectory.h"

#include <cmath>
#include <tuple>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "body/kinematics.h"
#include "core/rng.h"
#include "fixture.h"
#include "tests/tracker/frame_time.h"
#include "tracker/walk_prior.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;
using Eigen::VectorXd;

Pose upright(const BodyModel& model) {
  Pose pose;
  pose.root = {0, 0, leg_length(model.body.lengths) - 0.02};
  for (LegPose& leg : pose.legs) leg = {0.1, 0.02, 0, 0.2, 0.1};
  return pose;
}

// A frame whose images determine the pose to `sd` spreads of every number, around `pose`, with
// which the walker agrees.
FrameRecord seen(const BodyModel& model, const Pose& pose, double sd = 0.2) {
  const FreeNumbers free = free_numbers(model);
  FrameRecord record;
  record.tracked = true;
  record.estimate.joint_count = kJointCountWithoutArms;
  record.estimate.pose = pose;
  record.estimate.joints = forward_kinematics(model.body, pose).joints;
  const VectorXd information = (sd * spreads_of(free)).cwiseAbs2().cwiseInverse();
  record.images = {pose, pose, packed(free, information.asDiagonal())};
  return record;
}

Pose trembling(const BodyModel& model, Pose pose, double by, Rng& rng) {
  const FreeNumbers free = free_numbers(model);
  VectorXd off(static_cast<Eigen::Index>(free.size()));
  for (double& each : off) each = by * rng.normal();
  return with_values(free, pose, values_of(free, pose) + off.cwiseProduct(spreads_of(free)));
}

Vector2d foot(const BodyModel& model, const Pose& pose, Side side) {
  const JointPositions joints = forward_kinematics(model.body, pose).joints;
  return 0.5 * (joints[ankle(side)] + joints[toe(side)]).head<2>();
}

double travel(const BodyModel& model, std::span<const Pose> poses, const FlatFoot& flat) {
  Eigen::AlignedBox2d box;
  for (size_t t = flat.first; t <= flat.last; ++t) box.extend(foot(model, poses[t], flat.side));
  return box.diagonal().norm();
}

Poses most_probable(const BodyModel& model, std::span<const FrameRecord> records,
                    std::span<const FlatFoot> flat = {}, size_t settled = 0) {
  return most_probable_trajectory(model, {kDt, records, flat, settled}).poses;
}

// The same of somebody who walks in that direction.
Poses most_probable_walk(const BodyModel& model, std::span<const FrameRecord> records,
                         const Vector2d& ahead) {
  const std::vector<WalkingDirection> ways(records.size(), ahead);
  return most_probable_trajectory(model, {kDt, records, {}, 0, ways}).poses;
}

// Law: what goes on evenly, and is seen where it is, stays where it is.
TEST(MostProbableTrajectory, WhatGoesOnEvenlyStays) {
  const BodyModel model = test_model();
  std::vector<FrameRecord> records;
  Pose pose = upright(model);
  for (int t = 0; t < 20; ++t) {
    records.push_back(seen(model, pose));
    pose.root.x() += 0.04;
    pose.heading += 0.3;  // more than once around
    pose.legs[0].hip_flexion += 0.01;
  }
  const std::vector<Pose> poses = most_probable(model, records);
  const FreeNumbers free = free_numbers(model);
  ASSERT_EQ(poses.size(), records.size());
  for (size_t t = 0; t < poses.size(); ++t)
    EXPECT_LT(difference(free, records[t].estimate.pose, poses[t]).norm(), 1e-6) << t;
}

double acceleration_cost(double change, double acceleration, double dt) {
  return 0.5 * change * change / (4. / 3 * acceleration * acceleration * 0.025 * std::pow(dt, 3));
}

// The sum in the header, term by term, of poses and the best places for them.
double header_sum(const BodyModel& model, double dt, std::span<const FrameRecord> records,
                  std::span<const FlatFoot> flat, const WalkingDirection& way,
                  std::span<const Pose> poses) {
  const FreeNumbers free = free_numbers(model);
  const VectorXd s = spreads_of(free);
  const double k = std::min(1.0, 30 * dt);
  double sum = 0;
  for (size_t t = 0; t < poses.size(); ++t) {
    const ImageInformation& images = records[t].images;
    const VectorXd d = difference(free, images.pose, poses[t]);
    const VectorXd pull = difference(free, images.walker, images.pose).cwiseQuotient(s.cwiseAbs2());
    VectorXd off = difference(free, images.walker, poses[t]).cwiseQuotient(s);
    off.head<2>().setZero();
    sum += k * (0.5 * d.dot(unpacked(free, images) * d) - d.dot(pull)) +
           0.5 * 1.5 * dt * off.squaredNorm();
    if (t > 0 && t + 1 < poses.size()) {
      const VectorXd second =
          difference(free, poses[t], poses[t + 1]) - difference(free, poses[t - 1], poses[t]);
      for (Eigen::Index i = way ? 2 : 0; i < second.size(); ++i)
        sum += acceleration_cost(second[i], kPoseNumbers[free[size_t(i)]].acceleration, dt);
      if (way) {
        sum += acceleration_cost(way->dot(second.head<2>()), kPoseNumbers[0].acceleration, dt) +
               acceleration_cost(way->x() * second[1] - way->y() * second[0], 0.5, dt);
      }
    }
    const JointPositions joints = forward_kinematics(model.body, poses[t]).joints;
    if (way)
      sum += 0.5 * dt / 0.1 * legs_aside(joints, model.body.subject.height, *way).squaredNorm();
    for (const Side side : {Side::kLeft, Side::kRight})
      sum += 0.5 * std::pow(std::min(0.0, joints[toe(side)].z()) / 0.001, 2);
  }
  for (const FlatFoot& each : flat) {
    Vector2d place = Vector2d::Zero();
    const double count = static_cast<double>(each.last - each.first + 1);
    for (size_t t = each.first; t <= each.last; ++t)
      place += foot(model, poses[t], each.side) / count;
    for (size_t t = each.first; t <= each.last; ++t) {
      const JointPositions joints = forward_kinematics(model.body, poses[t]).joints;
      const double heel = joints[ankle(each.side)].z() - model.body.lengths.ankle_height;
      const double ball = joints[toe(each.side)].z() - model.body.lengths.ball_height;
      sum += 0.5 * (foot(model, poses[t], each.side) - place).squaredNorm() / (0.001 * 0.001);
      sum += 0.5 * dt / 0.1 * (heel * heel + ball * ball) / (0.03 * 0.03);
    }
  }
  return sum;
}

// A walk of some frames whose images and walker contradict each other, with a flat sole.
struct Contradiction {
  BodyModel model = test_model();
  FreeNumbers free = free_numbers(model);
  std::vector<FrameRecord> records;
  std::array<FlatFoot, 1> flat{FlatFoot{Side::kLeft, 2, 6}};

  WalkingDirection way;

  Contradiction(double dt, const Vector2d& velocity) {
    Rng rng(3, Purpose::kTest);
    Pose middle = upright(model);
    if (!velocity.isZero()) way = velocity.normalized();
    middle.heading = std::atan2(velocity.y(), velocity.x());
    middle.root.z() += 0.05;  // toes above the ground, which the ankles see to afterwards
    for (int t = 0; t < 8; ++t) {
      const Pose walker = trembling(model, middle, 0.5, rng);
      records.push_back(seen(model, trembling(model, walker, 0.5, rng)));
      records.back().images.walker = walker;
      middle.root.head<2>() += dt * velocity;
    }
  }
  double sum(double dt, std::span<const Pose> poses) const {
    return header_sum(model, dt, records, flat, way, poses);
  }
  Poses most_probable(double dt) const {
    const std::vector<WalkingDirection> ways(records.size(), way);
    return most_probable_trajectory(model, {dt, records, flat, 0, ways}).poses;
  }
  Pose aside(const Pose& pose, Eigen::Index number, double by) const {
    VectorXd values = values_of(free, pose);
    values[number] += by * spreads_of(free)[number];
    return with_values(free, pose, values);
  }
};

// By the frame rate, Hz, and the subject's velocity, m/s.
class AtFrameRate : public testing::TestWithParam<std::tuple<double, Vector2d>> {
 protected:
  const double dt_ = 1 / std::get<0>(GetParam());
  const Contradiction walk_{dt_, std::get<1>(GetParam())};
};
INSTANTIATE_TEST_SUITE_P(MostProbableTrajectory, AtFrameRate,
                         testing::Combine(testing::Values(15, 30, 60),
                                          testing::Values(Vector2d(0, 0), Vector2d(0.8, -1.2))));

// By an independent route: nowhere near it is the header's sum less, whichever number of whichever
// frame changes,
TEST_P(AtFrameRate, NoFrameElsewhereHasLessOfTheHeadersSum) {
  Poses poses = walk_.most_probable(dt_);
  const double least = walk_.sum(dt_, poses);
  for (size_t t = 0; t < poses.size(); ++t) {
    const Pose here = poses[t];
    for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(walk_.free.size()); ++k) {
      for (const double by : {-0.01, 0.01}) {
        poses[t] = walk_.aside(here, k, by);
        EXPECT_GT(walk_.sum(dt_, poses), least - 1e-6)
            << t << ' ' << kPoseNumbers[walk_.free[static_cast<size_t>(k)]].name << ' ' << by;
      }
    }
    poses[t] = here;
  }
}

// or that of all, with which the place of the flat sole moves.
TEST_P(AtFrameRate, NorDoAllFramesTogether) {
  const Poses poses = walk_.most_probable(dt_);
  const double least = walk_.sum(dt_, poses);
  for (Eigen::Index k = 0; k < static_cast<Eigen::Index>(walk_.free.size()); ++k) {
    for (const double by : {-0.01, 0.01}) {
      std::vector<Pose> elsewhere;
      for (const Pose& pose : poses) elsewhere.push_back(walk_.aside(pose, k, by));
      EXPECT_GT(walk_.sum(dt_, elsewhere), least - 1e-6)
          << kPoseNumbers[walk_.free[static_cast<size_t>(k)]].name << ' ' << by;
    }
  }
}

TEST(MostProbableTrajectory, AFlatSoleStaysAndNoToeIsInTheGround) {
  const BodyModel model = test_model();
  Rng rng(4, Purpose::kTest);
  std::vector<FrameRecord> records;
  std::vector<Pose> before;
  for (int t = 0; t < 30; ++t) {
    before.push_back(trembling(model, upright(model), 1, rng));
    before.back().root.z() -= 0.03;
    records.push_back(seen(model, before.back(), 1));
  }
  const FlatFoot flat{Side::kRight, 5, 25};
  const std::vector<Pose> poses = most_probable(model, records, {&flat, 1});
  EXPECT_GT(travel(model, before, flat), 0.05);
  EXPECT_LT(travel(model, poses, flat), 0.08 * travel(model, before, flat));
  const auto deepest = [&](std::span<const Pose> of) {
    double depth = 0;
    for (const Pose& pose : of) {
      const JointPositions joints = forward_kinematics(model.body, pose).joints;
      depth = std::min({depth, joints[Joint::kLeftToe].z(), joints[Joint::kRightToe].z()});
    }
    return depth;
  };
  EXPECT_LT(deepest(before), -0.02);
  EXPECT_GT(deepest(poses), -1e-6);
}

// Frames that show nothing follow the walker and those around them; what is seen pulls.
TEST(MostProbableTrajectory, WhoIsHiddenFollowsWalkerAndNeighbours) {
  const BodyModel model = test_model();
  std::vector<FrameRecord> records;
  Pose pose = upright(model);
  for (int t = 0; t < 21; ++t) {
    records.push_back(seen(model, pose));
    pose.root.x() += 0.04;
  }
  ImageInformation& hidden = records[10].images;
  std::fill(hidden.information.begin(), hidden.information.end(), 0.0);
  hidden.pose.root.y() += 0.02;  // where particles drift without images
  hidden.walker = hidden.pose;
  const std::vector<Pose> poses = most_probable(model, records);
  EXPECT_NEAR(poses[10].root.x(), 0.4, 1e-3);
  EXPECT_LT(std::abs(poses[10].root.y()), 0.005);
}

// What images show weakly of swaying, to and fro within a second, is believed along the walk and
// not across it.
TEST(MostProbableTrajectory, WhoWalksSwaysLittleToTheSide) {
  const BodyModel model = test_model();
  constexpr double kSway = 0.1;  // m
  const Vector2d ahead = Vector2d(1, 2).normalized(), left(-ahead.y(), ahead.x());
  // How far the trajectory is from what the images show, at most, m.
  const auto disbelieved = [&](const Vector2d& direction) {
    std::vector<FrameRecord> records;
    Pose pose = upright(model);
    pose.heading = std::atan2(ahead.y(), ahead.x());
    for (int t = 0; t < 61; ++t) {
      const double time = kDt * t;
      pose.root.head<2>() = 1.2 * time * ahead + kSway * std::sin(2 * kPi * time) * direction;
      records.push_back(seen(model, pose, 1));
    }
    const Poses poses = most_probable_walk(model, records, ahead);
    double most = 0;
    for (size_t t = 0; t < poses.size(); ++t)
      most = std::max(most, (poses[t].root - records[t].images.pose.root).head<2>().norm());
    return most;
  };
  EXPECT_LT(disbelieved(ahead), 0.3 * kSway);
  EXPECT_GT(disbelieved(left), 0.7 * kSway);
}

// Where the particles are over the ground follows from the same images: these alone decide. Their
// gradient at the pose that was found with the particles' help is that of the help.
TEST(MostProbableTrajectory, APlaceOverTheGroundIsThatOfTheImages) {
  const BodyModel model = test_model();
  constexpr double kOff = 0.01, kImages = 3;  // m, spreads
  FrameRecord record = seen(model, upright(model), kImages);
  record.images.walker.root.x() -= kOff;
  const Poses poses = most_probable(model, {&record, 1});
  EXPECT_NEAR(poses.at(0).root.x(), kImages * kImages * kOff, 1e-4);
}

TEST(MostProbableTrajectory, FixedOnesStayAndTheRestGoesOnFromThem) {
  const BodyModel model = test_model();
  Rng rng(5, Purpose::kTest);
  std::vector<FrameRecord> records;
  for (int t = 0; t < 40; ++t)
    records.push_back(seen(model, trembling(model, upright(model), 1, rng), 1));
  const FlatFoot flat{Side::kLeft, 8, 35};
  const std::vector<Pose> whole = most_probable(model, records, {&flat, 1});
  for (size_t t = 0; t < 20; ++t) records[t].estimate.pose = whole[t];
  const std::vector<Pose> rest = most_probable(model, records, {&flat, 1}, 20);
  const FreeNumbers free = free_numbers(model);
  for (size_t t = 0; t < 40; ++t) {
    const double off = difference(free, whole[t], rest[t]).norm();
    EXPECT_LT(off, t < 20 ? 1e-6 : 2e-3) << t;
  }
}

TEST(MostProbableTrajectory, OneFrameOrTwoAreTheirOwn) {
  const BodyModel model = test_model();
  const std::vector<FrameRecord> records(2, seen(model, upright(model)));
  EXPECT_TRUE(most_probable(model, {}).empty());
  for (const size_t count : {size_t{1}, size_t{2}}) {
    const auto poses = most_probable(model, std::span(records).first(count));
    ASSERT_EQ(poses.size(), count);
    EXPECT_LT(difference(free_numbers(model), upright(model), poses[0]).norm(), 1e-6);
  }
}

// The sum's second derivatives over the frames of one number, whose images know it to `sd`: by
// hand, from the header.
Eigen::MatrixXd precision_of(const PoseNumber& number, double sd, Eigen::Index frames) {
  Eigen::MatrixXd out = Eigen::MatrixXd::Zero(frames, frames);
  const double images = std::min(1.0, 30 * kDt) / (sd * sd);
  out.diagonal().array() += images;
  // The walker gives no evidence of a place over the ground.
  const bool place = &number == &kPoseNumbers[0] || &number == &kPoseNumbers[1];
  if (!place) out.diagonal().array() += 1.5 * kDt / (number.spread * number.spread);
  const double acceleration = number.acceleration;
  const double variance = 4. / 3 * acceleration * acceleration * 0.025 * std::pow(kDt, 3);
  for (Eigen::Index t = 1; t + 1 < frames; ++t) {
    const Eigen::Vector3d second(1, -2, 1);
    out.block<3, 3>(t - 1, t - 1) += second * second.transpose() / variance;
  }
  return out;
}

double drawn_value(const Poses& draw, size_t frame, size_t number) {
  return kPoseNumbers[number].in(draw[frame]);
}

// Law: draws vary as the inverse of the sum's second derivatives says, within a frame and between
// frames, and about the most probable poses.
TEST(MostProbableTrajectory, DrawsHaveTheCovarianceOfTheSum) {
  const BodyModel model = test_model();
  constexpr Eigen::Index kFrames = 5;
  constexpr double kDraws = 4000;
  Pose pose = upright(model);
  pose.root.z() += 0.1;  // no toe near the ground
  const std::vector<FrameRecord> records(kFrames, seen(model, pose));
  const std::vector<Poses> none(static_cast<size_t>(kDraws));
  const auto found = most_probable_trajectory(model, {kDt, records}, {none, 7, 0});
  for (const size_t number : {size_t{0}, size_t{5}, size_t{9}}) {
    const double middle = kPoseNumbers[number].in(pose);
    const Eigen::MatrixXd expected =
        precision_of(kPoseNumbers[number], 0.2 * kPoseNumbers[number].spread, kFrames).inverse();
    for (const auto& [a, b] : {std::pair{0, 0}, {2, 2}, {1, 2}, {0, 4}}) {
      double sum = 0;
      for (const Poses& draw : found.draws)
        sum += (drawn_value(draw, size_t(a), number) - middle) *
               (drawn_value(draw, size_t(b), number) - middle);
      // Five standard errors of a sample covariance.
      const double error =
          std::sqrt((expected(a, a) * expected(b, b) + std::pow(expected(a, b), 2)) / kDraws);
      EXPECT_NEAR(sum / kDraws, expected(a, b), 5 * error)
          << kPoseNumbers[number].name << ' ' << a << ' ' << b;
    }
  }
}

// A piece goes on from where each draw of the piece before has ended, not from the most probable
// poses: the mean of what follows is the conditional one of a normal distribution.
TEST(MostProbableTrajectory, DrawsGoOnFromThoseThatAreSettled) {
  const BodyModel model = test_model();
  constexpr Eigen::Index kFrames = 6, kSettled = 3;
  constexpr size_t kNumber = 9;  // a knee
  Pose pose = upright(model);
  pose.root.z() += 0.1;
  const std::vector<FrameRecord> records(kFrames, seen(model, pose));
  Pose aside = pose;
  const double sd = 0.2 * kPoseNumbers[kNumber].spread, off = 2 * sd;
  kPoseNumbers[kNumber].in(aside) += off;
  const std::vector<Poses> settled(1000, Poses(kSettled, aside));
  const auto found = most_probable_trajectory(model, {kDt, records, {}, kSettled}, {settled, 7, 0});
  const Eigen::MatrixXd precision = precision_of(kPoseNumbers[kNumber], sd, kFrames);
  const Eigen::VectorXd expected = -precision.bottomRightCorner(3, 3).inverse() *
                                   precision.bottomLeftCorner(3, 3) *
                                   Eigen::Vector3d::Constant(off);
  const Eigen::MatrixXd left = precision.bottomRightCorner(3, 3).inverse();
  for (Eigen::Index t = 0; t < 3; ++t) {
    double mean = 0;
    for (const Poses& draw : found.draws) {
      EXPECT_EQ(drawn_value(draw, size_t(t), kNumber), kPoseNumbers[kNumber].in(aside));
      mean += (drawn_value(draw, size_t(t + kSettled), kNumber) - kPoseNumbers[kNumber].in(pose)) /
              1000;
    }
    EXPECT_NEAR(mean, expected[t], 5 * std::sqrt(left(t, t) / 1000)) << t;
  }
  EXPECT_GT(expected[0], 0.2 * off) << "what is settled pulls, or this test would not see it";
}

}  // namespace
}  // namespace walktrack
