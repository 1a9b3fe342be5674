#include "mechanics/integrator.h"

#include <cmath>

#include <gtest/gtest.h>

namespace walktrack {
namespace {

using Eigen::VectorXd;

// The pendulum a'' = -sin a.
VectorXd pendulum(double, const VectorXd& y) { return Eigen::Vector2d(y(1), -std::sin(y(0))); }

double pendulum_energy(const VectorXd& y) { return 0.5 * y(1) * y(1) - std::cos(y(0)); }

VectorXd after(Integrator integrator, double time, int steps) {
  VectorXd y = Eigen::Vector2d(1, 0.3);
  for (int i = 0; i < steps; ++i) y = *integrate_step(integrator, pendulum, 0, time / steps, y);
  return y;
}

// log2 of the ratio of errors as the step halves is the order.
double order(Integrator integrator, int steps) {
  const VectorXd exact = after(Integrator::kRk4, 3, 6000);
  const double coarse = (after(integrator, 3, steps) - exact).norm();
  const double fine = (after(integrator, 3, 2 * steps) - exact).norm();
  return std::log2(coarse / fine);
}

TEST(Integrator, ErrorFallsAtTheStatedOrder) {
  EXPECT_NEAR(order(Integrator::kEuler, 2000), 1, 0.05);
  EXPECT_NEAR(order(Integrator::kMidpoint, 200), 2, 0.05);
  EXPECT_NEAR(order(Integrator::kRk4, 100), 4, 0.1);
}

TEST(Integrator, MidpointKeepsTheEnergyOfAPendulumBoundedWhereEulerGains) {
  const double start = pendulum_energy(Eigen::Vector2d(1, 0.3));
  const int steps = 5000;  // 500 s at 0.1 s, some 75 swings
  EXPECT_LT(std::abs(pendulum_energy(after(Integrator::kMidpoint, 500, steps)) - start), 2e-3);
  EXPECT_GT(pendulum_energy(after(Integrator::kEuler, 500, steps)) - start, 0.5);
}

TEST(Integrator, MidpointConservesQuadraticInvariantsAndIsReversible) {
  const Derivative circle = [](double, const VectorXd& y) {
    return VectorXd(Eigen::Vector2d(-y(1), y(0)) * (1 + y(0)));  // keeps |y|
  };
  VectorXd y = Eigen::Vector2d(0.6, 0.8);
  for (int i = 0; i < 1000; ++i) y = *integrate_step(Integrator::kMidpoint, circle, 0, 0.3, y);
  EXPECT_NEAR(y.norm(), 1, 1e-12);
  const VectorXd back = *integrate_step(Integrator::kMidpoint, circle, 0, -0.3,
                                        *integrate_step(Integrator::kMidpoint, circle, 0, 0.3, y));
  EXPECT_LT((back - y).norm(), 1e-13);
}

TEST(Integrator, MidpointSurvivesStiffnessThatBreaksTheExplicitOnes) {
  const Derivative stiff = [](double, const VectorXd& y) { return VectorXd(-1e8 * y); };
  const VectorXd one = VectorXd::Ones(1);
  EXPECT_LE(std::abs((*integrate_step(Integrator::kMidpoint, stiff, 0, 0.1, one))(0)), 1.0);
  EXPECT_GT(std::abs((*integrate_step(Integrator::kRk4, stiff, 0, 0.1, one))(0)), 1e20);
}

TEST(Integrator, ReportsDivergenceInsteadOfReturningIt) {
  const Derivative pole = [](double, const VectorXd& y) {
    return VectorXd(1 / (y.array() - y(0)));
  };
  for (const Integrator integrator :
       {Integrator::kEuler, Integrator::kRk4, Integrator::kMidpoint}) {
    EXPECT_FALSE(integrate_step(integrator, pole, 0, 0.1, VectorXd::Ones(1)).has_value());
  }
}

TEST(Integrator, PassesTheTime) {
  const Derivative ramp = [](double t, const VectorXd&) {
    return VectorXd::Constant(1, 4 * t * t * t);
  };
  const auto y = integrate_step(Integrator::kRk4, ramp, 1, 1, VectorXd::Zero(1));
  EXPECT_NEAR((*y)(0), 15, 1e-13);  // t^4 from 1 to 2; order 4 is exact on it
}

}  // namespace
}  // namespace walktrack
