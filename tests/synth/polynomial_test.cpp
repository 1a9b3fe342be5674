#include "synth/world/polynomial.h"

#include <algorithm>
#include <cmath>

#include <gtest/gtest.h>

#include "core/rng.h"

namespace walktrack {
namespace {

Quartic from_roots(std::array<double, 4> roots, double scale) {
  Quartic out{scale, 0, 0, 0, 0};
  for (int n = 0; n < 4; ++n) {
    Quartic next{};
    for (size_t i = 0; i < 4; ++i) {
      next[i] -= out[i] * roots[static_cast<size_t>(n)];
      next[i + 1] += out[i];
    }
    out = next;
  }
  return out;
}

TEST(FirstDescent, FindsTheFirstOfFourKnownRoots) {
  Rng rng(1, Purpose::kTest);
  for (int i = 0; i < 2000; ++i) {
    std::array<double, 4> roots;
    for (double& root : roots) root = rng.uniform();
    std::sort(roots.begin(), roots.end());
    if (roots[1] - roots[0] < 1e-3) continue;
    // Positive before the first root.
    const auto found = first_descent(from_roots(roots, 1 + 9 * rng.uniform()));
    ASSERT_TRUE(found.has_value());
    // Rounding of the coefficients moves a root by eps / |f'|, at worst 1e-16 / (1e-3)^3.
    EXPECT_NEAR(*found, roots[0], 1e-6);
  }
}

TEST(FirstDescent, TellsADescentFromARise) {
  // Negative first: between the roots .2 and .4 it is positive, and it descends at .4.
  const auto found = first_descent(from_roots({.2, .4, 2, 3}, -1));
  ASSERT_TRUE(found.has_value());
  EXPECT_NEAR(*found, .4, 1e-12);
  EXPECT_FALSE(first_descent(from_roots({.5, 2, 3, 4}, -1)).has_value());  // it only rises
}

TEST(FirstDescent, HandlesLowerDegreesAndNoRoots) {
  EXPECT_NEAR(first_descent({0.3, -1, 0, 0, 0}).value(), 0.3, 1e-15);
  EXPECT_NEAR(first_descent({0.25, 0, -1, 0, 0}).value(), 0.5, 1e-15);
  EXPECT_FALSE(first_descent({1, 0, 0, 0, 0}).has_value());
  EXPECT_FALSE(first_descent({1, -4, 4.001, 0, 0}).has_value());  // just misses zero
}

}  // namespace
}  // namespace walktrack
