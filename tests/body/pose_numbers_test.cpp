// The table of a pose's numbers.
#include "body/pose_numbers.h"

#include <set>

#include <gtest/gtest.h>

namespace walktrack {
namespace {

TEST(PoseNumbers, AreAllNumbersOfAPoseEachOnce) {
  Pose pose;
  std::set<const double*> places;
  std::set<std::string_view> names;
  for (const PoseNumber& number : kPoseNumbers) {
    places.insert(&number.in(pose));
    names.insert(number.name);
  }
  EXPECT_EQ(places.size(), kPoseNumbers.size());
  EXPECT_EQ(names.size(), kPoseNumbers.size());
}

TEST(PoseNumbers, BothSidesAreAlike) {
  for (const PoseNumber& left : kPoseNumbers) {
    if (left.limb() == Limb::kTrunk || left.side == Side::kRight) continue;
    int partners = 0;
    for (const PoseNumber& right : kPoseNumbers) {
      if (right.side != Side::kRight || right.leg != left.leg || right.arm != left.arm) continue;
      ++partners;
      EXPECT_EQ(right.name.substr(1), left.name.substr(1));
      EXPECT_EQ(right.spread, left.spread) << left.name;
      EXPECT_EQ(right.sideways, left.sideways) << left.name;
      EXPECT_EQ(right.lowest, left.lowest) << left.name;
    }
    EXPECT_EQ(partners, 1) << left.name;
  }
}

TEST(PoseNumbers, HeadingsDifferByTheShorterWay) {
  for (const PoseNumber& number : kPoseNumbers) {
    const double way = number.difference(3, 3 - 2 * kPi + 0.1);
    EXPECT_NEAR(way, number.name == "heading" ? 0.1 : 0.1 - 2 * kPi, 1e-12) << number.name;
  }
}

}  // namespace
}  // namespace walktrack
