#include "body/subject.h"

#include <gtest/gtest.h>

#include "body/body.h"

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

TEST(Girth, WidensAllPartsExceptHeadAndFeet) {
  const BodyGroups all{.head = true, .arms = true};
  const Body usual = make_body(Subject{}, all),
             wide = make_body(Subject{.lengths = {}, .girth = 1.3}, all);
  ASSERT_EQ(wide.parts.size(), usual.parts.size());
  size_t same = 0;
  for (size_t i = 0; i < usual.parts.size(); ++i) {
    const Part &a = usual.parts[i], &b = wide.parts[i];
    const bool stays = a.appearance == Appearance::kHead || a.appearance == Appearance::kFeet;
    same += stays;
    EXPECT_NEAR(b.at_upper.lateral, (stays ? 1 : 1.3) * a.at_upper.lateral, 1e-12) << i;
    EXPECT_NEAR(b.at_lower.forward, (stays ? 1 : 1.3) * a.at_lower.forward, 1e-12) << i;
    EXPECT_EQ(a.lower, b.lower) << "lengths stay";
  }
  EXPECT_EQ(same, 4u);
  EXPECT_EQ(wide.lengths.shank, usual.lengths.shank);
}

}  // namespace
}  // namespace walktrack
