#include "tracker/others/moving_person.h"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

namespace walktrack {
namespace {

using Eigen::Matrix2d;
using Eigen::Vector2d;

MovingPerson somebody() {
  Matrix2d place;
  place << 0.09, 0.02, 0.02, 0.04;
  return predicted(moving_person({1, 2}, place, {1.2, -0.3}, 0.5), 0.2);
}

TEST(MovingPerson, WalksOnAndBecomesLessCertain) {
  const MovingPerson now = somebody(), later = predicted(now, 0.5);
  EXPECT_TRUE(later.position().isApprox(now.position() + 0.5 * now.velocity()));
  EXPECT_EQ(later.velocity(), now.velocity());
  EXPECT_GT(later.position_covariance().determinant(), now.position_covariance().determinant());
  // Two steps are one of their length.
  const MovingPerson halves = predicted(predicted(now, 0.25), 0.25);
  EXPECT_TRUE(halves.mean.isApprox(later.mean));
  EXPECT_TRUE(halves.covariance.isApprox(later.covariance));
}

// By the textbook's gain.
TEST(MovingPerson, IsMeasuredAsByAKalmanFilter) {
  constexpr double kSd = 0.1;
  const MovingPerson before = somebody();
  const Vector2d seen(1.5, 1.8);
  const Matrix2d innovation = before.position_covariance() + kSd * kSd * Matrix2d::Identity();
  const Eigen::Matrix<double, 4, 2> gain =
      before.covariance.leftCols<2>() * innovation.ldlt().solve(Matrix2d::Identity());
  const MovingPerson after = measured_at(before, seen, kSd);
  EXPECT_TRUE(after.mean.isApprox(before.mean + gain * (seen - before.position()), 1e-12));
  EXPECT_TRUE(
      after.covariance.isApprox(before.covariance - gain * before.covariance.topRows<2>(), 1e-12));
}

TEST(MovingPerson, IsWhereTheyAreFound) {
  const MovingPerson before = somebody();
  const Vector2d place(1.1, 2.3);
  EXPECT_TRUE(found_at(before, place, 50 * Matrix2d::Identity()).position().isApprox(place));
  EXPECT_GT(found_at(before, place, 50 * Matrix2d::Identity()).velocity().y(),
            before.velocity().y());
}

TEST(MovingPerson, IsNoFasterThanPeopleWalk) {
  MovingPerson person = somebody();
  for (int i = 1; i < 10; ++i) person = measured_at(predicted(person, 0.1), {1 + 0.6 * i, 2}, 0.01);
  EXPECT_NEAR(person.velocity().norm(), 2.5, 1e-9);
}

}  // namespace
}  // namespace walktrack
