#include "tracker/detect/slight_walks.h"

#include <optional>

#include <gtest/gtest.h>

#include "tests/tracker/frame_time.h"

namespace walktrack {
namespace {

constexpr double kWindow = 1.2;  // s

// The window in which it is noticed that somebody walks whose walks are found at 1.2 m/s and move
// on by so many m/s. In every third window there is a walk, but not in those before `from`.
std::optional<uint32_t> noticed(double moves_on, double share, SlightWalks& walks,
                                uint32_t from = 0) {
  for (uint32_t first = from; first < 90; first += 3) {
    const DetectedWalk walk{
        .position = {moves_on * kDt * first, 1}, .velocity = {1.2, 0}, .over_standing = share};
    if (walks_on(first, walk, kWindow, kDt, walks)) return first;
  }
  return std::nullopt;
}

TEST(SlightWalks, ThatMoveOnAreOfSomebodyWhoWalks) {
  for (const double speed : {0.7, 1.2, 2.0}) {
    SlightWalks walks;
    const auto first = noticed(speed, 0.05, walks);
    ASSERT_TRUE(first) << speed;
    EXPECT_NEAR(*first * kDt, 0.75, 0.15);
    EXPECT_EQ(walks.moved_on_from, 0u);
  }
}

TEST(SlightWalks, ThatStayOrMoveBackAreNot) {
  for (const double speed : {0.0, 0.4, -1.2}) {
    SlightWalks walks;
    EXPECT_FALSE(noticed(speed, 0.05, walks)) << speed;
    EXPECT_LE(walks.newest.size(), size_t(kWindow / kDt / 3) + 2);
  }
}

TEST(SlightWalks, ThatStandingExplainsAsWellSayNothing) {
  SlightWalks walks;
  EXPECT_FALSE(noticed(1.2, 0.01, walks));
}

TEST(SlightWalks, OfLongAgoAreForgotten) {
  SlightWalks walks;
  walks.newest.push_back({0, {-40, 1}});
  EXPECT_NEAR(*noticed(1.2, 0.05, walks, 48) * kDt, 48 * kDt + 0.75, 0.15);
  EXPECT_EQ(walks.moved_on_from, 48u);
}

TEST(SlightWalks, AreBelievedAfterThatUntilOneSaysNothing) {
  SlightWalks walks;
  ASSERT_TRUE(noticed(1.2, 0.05, walks));
  const auto again = [&](uint32_t first, double share) {
    return walks_on(first, {.velocity = {1.2, 0}, .over_standing = share}, kWindow, kDt, walks);
  };
  EXPECT_TRUE(again(1, 0.05));
  EXPECT_TRUE(again(40, 0.05));
  EXPECT_FALSE(again(43, 0.01));
  EXPECT_FALSE(again(44, 0.05));
}

TEST(SlightWalks, OfSomebodyMuchLaterAreNotBelievedForIt) {
  SlightWalks walks;
  ASSERT_TRUE(noticed(1.2, 0.05, walks));
  const DetectedWalk other{.velocity = {1.2, 0}, .over_standing = 0.05};
  EXPECT_TRUE(walks_on(60, other, kWindow, kDt, walks));
  EXPECT_FALSE(walks_on(90, other, kWindow, kDt, walks));
}

}  // namespace
}  // namespace walktrack
