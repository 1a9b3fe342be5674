#include "tracker/state/free_numbers.h"

#include <gtest/gtest.h>

#include "core/conventions.h"
#include "fixture.h"

namespace walktrack {
namespace {

TEST(FreeNumbers, AreThoseOfThePathAndTheBody) {
  BodyModel model = test_model();
  EXPECT_EQ(free_numbers(model).size(), 16u);
  model.body.groups.arms = true;
  EXPECT_EQ(free_numbers(model).size(), kPoseNumbers.size());
  for (const size_t i : free_numbers(test_model(Path::kSagittal)))
    EXPECT_FALSE(kPoseNumbers[i].sideways) << kPoseNumbers[i].name;
}

TEST(FreeNumbers, ComeBackAsTheyWereAndKneesDoNotBendBackwards) {
  const FreeNumbers free = free_numbers(test_model());
  Pose pose;
  for (const size_t i : free) kPoseNumbers[i].in(pose) = 0.1 * static_cast<double>(i);
  EXPECT_EQ(values_of(free, with_values(free, {}, values_of(free, pose))), values_of(free, pose));
  const Pose low = with_values(free, pose, values_of(free, pose).array() - 10);
  EXPECT_EQ(low.legs[0].knee_flexion, 0);
  EXPECT_LT(low.root.x(), -9);
}

TEST(FreeNumbers, HeadingsDifferByTheShorterWay) {
  const FreeNumbers free = free_numbers(test_model());
  Pose from, to;
  from.heading = 3.1;
  to.heading = -3.1;
  EXPECT_NEAR(difference(free, from, to).norm(), 2 * kPi - 6.2, 1e-12);
}

}  // namespace
}  // namespace walktrack
