#include "core/rng.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

namespace walktrack {
namespace {

// Published vectors of the reference implementation (Random123, kat_vectors, philox4x32-10).
TEST(Philox, PublishedVectors) {
  using Block = std::array<uint32_t, 4>;
  EXPECT_EQ(philox4x32({0, 0, 0, 0}, {0, 0}),
            (Block{0x6627e8d5, 0xe169c58d, 0xbc57ac4c, 0x9b00dbd8}));
  EXPECT_EQ(philox4x32({~0u, ~0u, ~0u, ~0u}, {~0u, ~0u}),
            (Block{0x408f276d, 0x41c83b0e, 0xa20bc7c6, 0x6d5451fd}));
  EXPECT_EQ(philox4x32({0x243f6a88, 0x85a308d3, 0x13198a2e, 0x03707344}, {0xa4093822, 0x299f31d0}),
            (Block{0xd16cfe09, 0x94fdcceb, 0x5001e420, 0x24126ea1}));
}

TEST(Rng, EqualKeysGiveEqualStreamsAndAnyPartOfTheKeyChangesThem) {
  const auto first = [](Rng rng) { return rng.uniform(); };
  const double reference = first(Rng(7, Purpose::kTest, 3, 5));
  EXPECT_EQ(first(Rng(7, Purpose::kTest, 3, 5)), reference);
  EXPECT_NE(first(Rng(8, Purpose::kTest, 3, 5)), reference);
  EXPECT_NE(first(Rng(7, Purpose::kMoves, 3, 5)), reference);
  EXPECT_NE(first(Rng(7, Purpose::kTest, 4, 5)), reference);
  EXPECT_NE(first(Rng(7, Purpose::kTest, 3, 6)), reference);
}

TEST(Rng, MomentsOfUniformAndNormal) {
  constexpr int kDraws = 200000;
  const double k_sigma = 5.0 / std::sqrt(double{kDraws});
  Rng rng(1, Purpose::kTest);
  double u1 = 0, u2 = 0, n1 = 0, n2 = 0, n4 = 0;
  for (int i = 0; i < kDraws; ++i) {
    const double u = rng.uniform();
    ASSERT_GT(u, 0.0);
    ASSERT_LT(u, 1.0);
    u1 += u / kDraws;
    u2 += u * u / kDraws;
    const double n = rng.normal();
    n1 += n / kDraws;
    n2 += n * n / kDraws;
    n4 += n * n * n * n / kDraws;
  }
  // Tolerance: 5 standard errors; the variances of u, u^2, n, n^2, n^4 are 1/12, 4/45, 1, 2, 96.
  EXPECT_NEAR(u1, 1.0 / 2, k_sigma * std::sqrt(1.0 / 12));
  EXPECT_NEAR(u2, 1.0 / 3, k_sigma * std::sqrt(4.0 / 45));
  EXPECT_NEAR(n1, 0.0, k_sigma);
  EXPECT_NEAR(n2, 1.0, k_sigma * std::sqrt(2.0));
  EXPECT_NEAR(n4, 3.0, k_sigma * std::sqrt(96.0));
}

TEST(Rng, TruncatedNormalStaysInside) {
  Rng rng(2, Purpose::kTest);
  for (int i = 0; i < 10000; ++i) EXPECT_LE(std::abs(rng.truncated_normal(0.5)), 0.5);
}

}  // namespace
}  // namespace walktrack
