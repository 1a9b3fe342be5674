// Finds the gaits of published walkers near a guess, and compares them with what was printed.
#pragma once

#include <algorithm>
#include <cmath>
#include <complex>
#include <initializer_list>
#include <stdexcept>

#include <gtest/gtest.h>

#include "tests/walker/find_gait.h"
#include "walker/linkage/linkage_walker.h"
#include "walker/linkage/models.h"

namespace walktrack {

inline Eigen::VectorXd vector(std::initializer_list<double> values) {
  Eigen::VectorXd v(static_cast<Eigen::Index>(values.size()));
  std::copy(values.begin(), values.end(), v.begin());
  return v;
}

// Time is in units of sqrt(l / g), about a second: RK4 at 4e-3 has errors of 1e-10.
inline GaitOptions fine_steps() {
  GaitOptions result;
  result.simulation.max_step = 4e-3;
  return result;
}

// The guess is wrong by a few parts in a thousand, so that Newton's method has to converge.
inline GaitCycle gait_near(const Walker& walker, const Eigen::VectorXd& guess) {
  Eigen::VectorXd off = guess;
  for (Eigen::Index i = guess.size() / 2; i < guess.size(); ++i) off(i) *= 1.002;
  const auto gait = find_gait(walker, off, fine_steps());
  if (!gait) throw std::runtime_error("no cycle found");
  return *gait;
}

inline void expect_multipliers(const GaitCycle& gait,
                               std::initializer_list<std::complex<double>> expected) {
  Eigen::Index i = 0;
  for (const std::complex<double>& value : expected) {
    ASSERT_LT(i, gait.cycle.multipliers.size());
    EXPECT_NEAR(gait.cycle.multipliers(i).real(), value.real(), 1e-3);
    EXPECT_NEAR(std::abs(gait.cycle.multipliers(i).imag()), std::abs(value.imag()), 1e-3);
    ++i;
  }
}

inline void expect_relative(double value, double expected, double tolerance = 1e-6) {
  EXPECT_NEAR(value, expected, tolerance * std::abs(expected));
}

// Garcia's limit: a hip infinitely heavier than point feet. Masses of 1e-10 give errors of 1e-10.
inline StraightLeggedParameters garcia(double slope) {
  StraightLeggedParameters p;
  p.slope = slope;
  p.hip_mass = 1;
  p.leg_mass = 1e-10;
  p.leg_inertia = 0;
  p.hip_to_arc = 1;
  p.com_below_hip = 1;
  p.foot_radius = 0;
  return p;
}

}  // namespace walktrack
