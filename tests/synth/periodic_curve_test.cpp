#include "synth/walk/periodic_curve.h"

#include <algorithm>

#include <gtest/gtest.h>

namespace walktrack {
namespace {

const std::vector<CurveKey> kKeys{{0, -2}, {.2, 0}, {.4, 0}, {.6, 5}, {.9, -3}};

TEST(PeriodicCurve, GoesThroughItsKeysEveryStride) {
  const PeriodicCurve curve(kKeys);
  for (const CurveKey& key : kKeys) {
    EXPECT_NEAR(curve(key.at), key.value, 1e-9);
    EXPECT_NEAR(curve(key.at + 3), key.value, 1e-9);
    EXPECT_NEAR(curve(key.at - 2), key.value, 1e-9);
  }
}

TEST(PeriodicCurve, StaysBetweenNeighbouringKeys) {
  const PeriodicCurve curve(kKeys);
  for (size_t i = 0; i < kKeys.size(); ++i) {
    const CurveKey a = kKeys[i];
    const CurveKey b = i + 1 < kKeys.size() ? kKeys[i + 1] : CurveKey{1, kKeys[0].value};
    for (double s = 0; s <= 1; s += .05) {
      const double value = curve(a.at + s * (b.at - a.at));
      EXPECT_GE(value, std::min(a.value, b.value) - 1e-12);
      EXPECT_LE(value, std::max(a.value, b.value) + 1e-12);
    }
  }
}

TEST(PeriodicCurve, HasNoCorner) {
  const PeriodicCurve curve(kKeys);
  constexpr double h = 1e-6;
  for (const CurveKey& key : kKeys)
    EXPECT_NEAR(curve(key.at + h) - curve(key.at), curve(key.at) - curve(key.at - h), 1e-9);
}

}  // namespace
}  // namespace walktrack
