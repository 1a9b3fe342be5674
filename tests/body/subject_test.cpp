#include "body/subject.h"

#include <gtest/gtest.h>

namespace walktrack {
namespace {

TEST(BodyLengths, FollowTheStatureUnlessGiven) {
  Subject subject{.height = 2.0, .mass = 80, .lengths = {}};
  EXPECT_DOUBLE_EQ(body_lengths(subject).thigh, 0.49);
  EXPECT_DOUBLE_EQ(body_lengths(subject).shank, 0.492);
  EXPECT_DOUBLE_EQ(leg_length(body_lengths(subject)), 0.49 + 0.492 + 0.078);
  subject.lengths.thigh = 0.4;
  EXPECT_DOUBLE_EQ(body_lengths(subject).thigh, 0.4);
  EXPECT_DOUBLE_EQ(body_lengths(subject).shank, 0.492);
}

TEST(BodyLengths, HeadStandsAtTheStature) {
  const BodyLengths l = body_lengths(Subject{.height = 1.75, .mass = 70, .lengths = {}});
  // The centre of the head lies half a head's height (.13 H / 2) below the vertex.
  EXPECT_NEAR(leg_length(l) + l.head, (1 - 0.065) * 1.75, 1e-9);
}

}  // namespace
}  // namespace walktrack
