#include "tracker/smooth/model_error.h"

#include <cmath>
#include <utility>

#include <gtest/gtest.h>

#include "core/conventions.h"
#include "tests/camera/made_camera.h"

namespace walktrack {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

const Vector3d kHead(0, 0, 1.6), kFeet(0, 0, 0.1);

Camera camera_from(const Vector3d& camera_position) {
  return looking_at(lens({640, 480}, {600, 600}, {319.5, 239.5}), camera_position, {0, 0, 0.85});
}

double sd_along(const Matrix3d& covariance, const Vector3d& direction) {
  return std::sqrt(direction.dot(covariance * direction));
}

// The formula in the header: both ends have an error e and are h apart, at a distance D much larger
// than h.
TEST(FigureCovariance, OneCameraKnowsTheDistanceLeast) {
  const double distance = 12, height = kHead.z() - kFeet.z();
  const std::vector<Camera> cameras{camera_from({0, -distance, 0.85})};
  const Matrix3d covariance = figure_covariance(cameras, kHead, kFeet);
  const double aside = sd_along(covariance, Vector3d::UnitX());
  const double along = sd_along(covariance, Vector3d::UnitY());
  // Two views of one number; the ends are h/2 off the axis on either side, hence D / (h/2).
  // Unobserved numbers are known to a metre.
  const double seen = aside * distance / (height / 2), expected = seen / std::hypot(1, seen);
  EXPECT_NEAR(along, expected, 0.01 * expected);
  EXPECT_NEAR(sd_along(covariance, Vector3d::UnitZ()), aside, 0.01 * aside);
}

TEST(FigureCovariance, TurnsWithTheWorld) {
  const std::vector<Camera> cameras{camera_from({2, -6, 1.5}), camera_from({5, 3, 2})};
  const Matrix3d turn = Eigen::AngleAxisd(0.7, Vector3d(1, 2, -1).normalized()).matrix();
  std::vector<Camera> turned = cameras;
  for (Camera& camera : turned) camera.rotation = camera.rotation * turn.transpose();
  const Matrix3d expected = turn * figure_covariance(cameras, kHead, kFeet) * turn.transpose();
  EXPECT_TRUE(figure_covariance(turned, turn * kHead, turn * kFeet).isApprox(expected, 1e-9));
}

TEST(FigureCovariance, ACameraMoreTellsMore) {
  std::vector<Camera> cameras;
  double before = figure_covariance(cameras, kHead, kFeet).trace();
  EXPECT_NEAR(before, 3, 1e-9) << "unseen: known to a metre";
  for (const Vector3d& camera_position :
       {Vector3d(0, -7, 1), Vector3d(6, -2, 2), Vector3d(-4, 5, 1.5)}) {
    cameras.push_back(camera_from(camera_position));
    const double now = figure_covariance(cameras, kHead, kFeet).trace();
    EXPECT_LT(now, before);
    before = now;
  }
}

TEST(FigureCovariance, ACameraThatLooksAwayTellsNothing) {
  const std::vector<Camera> one{camera_from({0, -7, 1})};
  std::vector<Camera> two = one;
  two.push_back(looking_at(lens({640, 480}, {600, 600}, {319.5, 239.5}), {5, 0, 1}, {20, 0, 1}));
  EXPECT_EQ(figure_covariance(one, kHead, kFeet), figure_covariance(two, kHead, kFeet));
}

// A subject who walks out of the picture is not lost at once: the error grows by a fifth of the
// way.
TEST(FigureCovariance, GrowsWithTheWayOutsideOfThePicture) {
  const std::vector<Camera> cameras{camera_from({0, -4, 0.85})};
  const auto sd_at = [&](double x) {  // upwards, which does not depend on the distance
    const Vector3d aside(x, 0, 0);
    return sd_along(figure_covariance(cameras, kHead + aside, kFeet + aside), Vector3d::UnitZ());
  };
  double edge = 0;
  while (inside_image(cameras[0], *project(cameras[0], {edge, 0, 0.85}))) edge += 1e-3;
  const double inside = sd_at(edge - 2e-3);
  EXPECT_NEAR(sd_at(edge + 1e-3), inside, 0.02 * inside) << "no jump";
  for (const double outside : {0.2, 0.5, 1.0}) {
    const double drift = 0.2 * outside / std::sqrt(2);  // of two ends together
    EXPECT_NEAR(sd_at(edge + outside), std::hypot(inside, drift), 0.1 * drift) << outside;
  }
  EXPECT_GT(sd_at(50), 0.8) << "far away nothing is known";
}

FrameEstimate upright_estimate() {
  FrameEstimate estimate;
  estimate.joint_count = kJointCountWithoutArms;
  estimate.joints[Joint::kHead] = kHead;
  for (const Joint ankle : {Joint::kLeftAnkle, Joint::kRightAnkle}) estimate.joints[ankle] = kFeet;
  return estimate;
}

TEST(AddModelError, WidensEverySpreadAndLeavesMeans) {
  FrameEstimate estimate = upright_estimate();
  // Skewed, with few outliers that pull the mean out of its band.
  for (auto& joint : estimate.spread) joint.fill({1, 0.01, 0.99, 1.03});
  estimate.spread[0][0] = {1, 0.01, 1.001, 1.004};
  estimate.angles.fill({0.5, 0.02, 0.48, 0.53});
  const FrameEstimate before = estimate;
  add_model_error(std::vector{camera_from({0, -7, 1})}, 1, estimate);
  for (size_t j = 0; j < estimate.joint_count; ++j) {
    for (size_t axis = 0; axis < 3; ++axis) {
      const Spread &was = before.spread[j][axis], &is = estimate.spread[j][axis];
      EXPECT_EQ(is.mean, was.mean);
      EXPECT_GT(is.sd, was.sd);
      EXPECT_LT(is.p05, was.p05);
      EXPECT_GT(is.p95, was.p95);
      EXPECT_LE(is.p05, is.mean);
    }
  }
  // A joint that is not modelled is not changed.
  EXPECT_EQ(estimate.spread[kJointCountWithoutArms][0].sd, 0.01);
  EXPECT_GT(estimate.angles[kKneeAngleL].sd, before.angles[kKneeAngleL].sd);
  // The camera looks along y: the distance is known least.
  EXPECT_GT(estimate.spread[1][1].sd, 3 * estimate.spread[1][0].sd);
}

// Knees are higher or lower than those of other people of the same stature: percentiles of Gordon
// et al. 1989 and a correlation with the stature of .84. Ankles are not.
TEST(AddModelError, KneesHaveTheHeightsThatPeopleHave) {
  FrameEstimate estimate = upright_estimate();
  for (auto& joint : estimate.spread) joint.fill({1, 0.01, 0.99, 1.01});
  add_model_error(std::vector{camera_from({0, -7, 1})}, 1, estimate);
  const double among_men = (0.606 - 0.514) / (2 * 1.645);
  const double of_one_stature = among_men * std::sqrt(1 - 0.84 * 0.84);
  for (const auto& [knee, ankle] : {std::pair(Joint::kLeftKnee, Joint::kLeftAnkle),
                                    std::pair(Joint::kRightKnee, Joint::kRightAnkle)}) {
    const auto variance = [&](Joint joint, size_t axis) {
      return std::pow(estimate.spread[static_cast<size_t>(joint)][axis].sd, 2);
    };
    EXPECT_NEAR(std::sqrt(variance(knee, 2) - variance(ankle, 2)), of_one_stature, 5e-4);
    for (const size_t axis : {0, 1}) EXPECT_EQ(variance(knee, axis), variance(ankle, axis));
  }
}

// If particles agree, the band is that of the model error alone: the 5th and 95th percentile of a
// normal distribution (Abramowitz & Stegun 1964, table 26.5), with its standard deviation.
TEST(AddModelError, BandsHoldNineTenthsOfANormalError) {
  FrameEstimate estimate = upright_estimate();
  for (auto& joint : estimate.spread) joint.fill({1, 0, 1, 1});
  estimate.angles.fill({0.2, 0, 0.2, 0.2});
  add_model_error(std::vector<Camera>{camera_from({0, -7, 1})}, 1, estimate);
  constexpr double kNormal95 = 1.6449;
  for (const Spread& each :
       {estimate.spread[size_t(Joint::kLeftAnkle)][2], estimate.spread[size_t(Joint::kHead)][0],
        estimate.angles[kKneeAngleL]}) {
    ASSERT_GT(each.sd, 0);
    EXPECT_NEAR((each.p95 - each.mean) / each.sd, kNormal95, 1e-3);
    EXPECT_NEAR((each.mean - each.p05) / each.sd, kNormal95, 1e-3);
  }
}

// Two views of the same body err alike: what one camera sees across its view is as certain as with
// many.
TEST(FigureCovariance, CamerasErrAlike) {
  const std::vector<Camera> one{camera_from({0, -30, 0.85})};
  std::vector<Camera> many;
  for (int i = 0; i < 8; ++i) {
    const double angle = i * kPi / 4;
    many.push_back(camera_from({30 * std::sin(angle), 30 * std::cos(angle), 0.85}));
  }
  const double across = sd_along(figure_covariance(one, kHead, kFeet), Vector3d::UnitZ());
  EXPECT_NEAR(sd_along(figure_covariance(many, kHead, kFeet), Vector3d::UnitZ()), across,
              0.01 * across);
}

TEST(FigureRoot, IsTheRootOfTheCovariance) {
  JointPositions joints;
  joints[Joint::kHead] = kHead;
  for (const Joint ankle : {Joint::kLeftAnkle, Joint::kRightAnkle}) joints[ankle] = kFeet;
  const std::vector<Camera> cameras{camera_from({2, -6, 1.5})};
  const Matrix3d root = figure_root(cameras, joints);
  EXPECT_TRUE(root.isApprox(root.transpose(), 1e-9));
  EXPECT_TRUE((root * root).isApprox(figure_covariance(cameras, kHead, kFeet), 1e-9));
}

// Law: the process keeps its variance, and forgets as the header says.
TEST(ModelErrorDraw, KeepsItsVarianceAndForgetsAsStated) {
  constexpr int kDraws = 4000;
  constexpr double kPassingTime = 0.12, kLasting = 0.6;
  const Matrix3d figure = Vector3d(0.03, 0.02, 0.01).asDiagonal();
  const auto pelvis = [](const JointPositions& joints) { return joints[Joint::kPelvis].x(); };
  double first = 0, last = 0, soon = 0;
  for (uint32_t draw = 0; draw < kDraws; ++draw) {
    ModelErrorDraw error(3, draw);
    const double a = pelvis(error.next(kPassingTime / 4, figure));
    double b = 0;
    for (int i = 0; i < 4; ++i) b = pelvis(error.next(kPassingTime / 4, figure));
    for (int i = 0; i < 100; ++i) error.next(kPassingTime / 4, figure);
    const double c = pelvis(error.next(kPassingTime / 4, figure));
    first += a * a / kDraws;
    last += c * c / kDraws;
    soon += a * b / kDraws;
  }
  const double variance = 0.03 * 0.03, error = 5 * variance * std::sqrt(2. / kDraws);
  EXPECT_NEAR(first, variance, error);
  EXPECT_NEAR(last, variance, error);
  EXPECT_NEAR(soon, variance * (kLasting + (1 - kLasting) * 2 * std::exp(-1)), error);
}

TEST(ModelErrorDraw, IsAFunctionOfSeedAndDraw) {
  const Matrix3d figure = 0.02 * Matrix3d::Identity();
  ModelErrorDraw one(3, 5), same(3, 5), other(3, 6);
  const auto head = [&](ModelErrorDraw& draw) { return draw.next(0.03, figure)[Joint::kHead]; };
  for (int i = 0; i < 3; ++i) {
    const Vector3d a = head(one);
    EXPECT_EQ(a, head(same));
    EXPECT_NE(a, head(other));
  }
}

}  // namespace
}  // namespace walktrack
