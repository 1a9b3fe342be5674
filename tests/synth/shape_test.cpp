#include "synth/world/shape.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "synth/world/figure.h"

namespace walktrack {
namespace {

Body usual() { return make_body(Subject{}, {.head = true, .arms = true}); }

const Part& part_of(const Body& body, Segment segment, Appearance appearance) {
  return *std::find_if(body.parts.begin(), body.parts.end(), [&](const Part& part) {
    return part.segment == segment && part.appearance == appearance;
  });
}

TEST(Shape, WithoutOneABodyStaysAsItIs) {
  const Body before = usual(), after = shaped(usual(), {});
  ASSERT_EQ(after.parts.size(), before.parts.size());
  for (size_t i = 0; i < before.parts.size(); ++i) {
    EXPECT_EQ(after.parts[i].lower, before.parts[i].lower);
    EXPECT_EQ(after.parts[i].upper, before.parts[i].upper);
    EXPECT_EQ(after.parts[i].at_lower.lateral, before.parts[i].at_lower.lateral);
    EXPECT_EQ(after.parts[i].at_upper.forward, before.parts[i].at_upper.forward);
  }
}

TEST(Shape, GirthWidensAllButFeetAndHead) {
  const Body before = usual(), after = shaped(usual(), {.girth = 1.3});
  for (size_t i = 0; i < before.parts.size(); ++i) {
    const Part &was = before.parts[i], &is = after.parts[i];
    const bool same = was.appearance == Appearance::kFeet || was.appearance == Appearance::kHead;
    EXPECT_NEAR(is.at_lower.lateral, (same ? 1 : 1.3) * was.at_lower.lateral, 1e-12);
    EXPECT_NEAR(is.at_upper.forward, (same ? 1 : 1.3) * was.at_upper.forward, 1e-12);
  }
}

TEST(Shape, ABellyReachesForwardAndTheBackStays) {
  const Body before = usual(), after = shaped(usual(), {.belly = 0.1});
  const auto ends = [](const Body& body) {
    const Part& low = body.parts[1];  // hips to waist
    const double x = low.upper.x(), half = low.at_upper.forward;
    return std::pair{x - half, x + half};
  };
  EXPECT_NEAR(ends(after).first, ends(before).first, 1e-12);
  EXPECT_NEAR(ends(after).second, ends(before).second + 0.1, 1e-12);
}

TEST(Shape, TrousersStandOffTheAnklesAndNotTheKnees) {
  const Body before = usual(), after = shaped(usual(), {.trousers = 0.05});
  double at_ankle = 0, at_knee = 1;
  for (size_t i = 0; i < before.parts.size(); ++i) {
    const Part& part = before.parts[i];
    if (part.segment != Segment::kLeftShank) continue;
    if (part.upper.z() == 0) at_knee = after.parts[i].at_upper.lateral - part.at_upper.lateral;
    if (part.lower.z() == -before.lengths.shank)
      at_ankle = after.parts[i].at_lower.lateral - part.at_lower.lateral;
  }
  EXPECT_NEAR(at_ankle, 0.05, 1e-12);
  EXPECT_NEAR(at_knee, 0, 1e-12);
}

TEST(Shape, ASkirtHidesTheThighsAndABagIsBehindTheBack) {
  const Body body = shaped(usual(), {.skirt = 0.8, .pack = 0.2});
  ASSERT_EQ(body.parts.size(), usual().parts.size() + 2);
  ASSERT_LE(body.parts.size(), kMaxParts);
  const Part &skirt = *(body.parts.end() - 2), &pack = body.parts.back();
  EXPECT_NEAR(skirt.lower.z(), -0.8 * body.lengths.thigh, 1e-12);
  EXPECT_GT(skirt.at_lower.lateral, skirt.at_upper.lateral);
  const Part& chest = part_of(body, Segment::kTrunk, Appearance::kTrunk);
  EXPECT_LT(pack.lower.x() + pack.at_lower.forward, -0.5 * chest.at_upper.forward);
}

}  // namespace
}  // namespace walktrack
