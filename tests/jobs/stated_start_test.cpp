#include "jobs/track/report/stated_start.h"

#include <gtest/gtest.h>

namespace walktrack {
namespace {

// The pelvis of somebody who is tracked from `from` s on and walks along x, 10 rows a second.
Motion tracked_from(double from) {
  Motion out;
  for (int i = 0; i < 30; ++i) {
    JointPositions joints = unknown_joints();
    if (0.1 * i > from - 1e-6) joints[Joint::kPelvis] = {0.12 * i, 2, 0.9};
    out.time.push_back(0.1 * i);
    out.joints.push_back(joints);
  }
  return out;
}

std::optional<std::string> note(const Motion& motion, const Eigen::Vector2d& place) {
  InitialState stated;
  stated.time = 0.5;
  stated.position = place;
  return stated_start_note(motion, stated);
}

TEST(StatedStart, NothingIsSaidOfASubjectWhoIsThere) {
  for (const double from : {0.0, 0.5})
    EXPECT_FALSE(note(tracked_from(from), {0.6, 2.3}).has_value()) << from;
}

TEST(StatedStart, SaysWhereTheWalkBeginsInstead) {
  const auto beside = note(tracked_from(0), {0.6, 2.6});
  ASSERT_TRUE(beside);
  EXPECT_NE(beside->find("at (0.60, 2.60) m"), std::string::npos) << *beside;
  EXPECT_NE(beside->find("begins at (0.60, 2.00) m, at 0.50 s"), std::string::npos) << *beside;
  const auto later = note(tracked_from(0.8), {0.6, 2});
  ASSERT_TRUE(later);
  EXPECT_NE(later->find("begins at (0.96, 2.00) m, at 0.80 s"), std::string::npos) << *later;
}

TEST(StatedStart, ThereMayBeNobody) {
  const auto nobody = note(tracked_from(9), {0.6, 2});
  ASSERT_TRUE(nobody);
  EXPECT_EQ(nobody->find("begins at"), std::string::npos) << *nobody;
  EXPECT_NE(nobody->find("was not found at (0.60, 2.00) m"), std::string::npos) << *nobody;
}

}  // namespace
}  // namespace walktrack
