#include "synth/world/polynomial.h"

#include <algorithm>
#include <cmath>

namespace walktrack {
inline namespace synth {

namespace {

// Few bisections suffice for Newton's method to converge; from there it doubles the digits.
constexpr int kMostIterations = 60;
constexpr double kUnitRounding = 1e-16;

struct Roots {
  std::array<double, 4> at;
  int count = 0;
  void add(double root) { at[static_cast<size_t>(count++)] = root; }
};

double value(const double* c, int degree, double u) {
  double sum = c[degree];
  for (int i = degree - 1; i >= 0; --i) sum = sum * u + c[i];
  return sum;
}

double slope(const double* c, int degree, double u) {
  double sum = degree * c[degree];
  for (int i = degree - 1; i >= 1; --i) sum = sum * u + i * c[i];
  return sum;
}

// The root in [lo, hi] of a polynomial that is monotone there and changes sign: Newton's method,
// with bisection if it would leave the bracket.
double bracketed_root(const double* c, int degree, double lo, double hi, double value_lo) {
  double u = 0.5 * (lo + hi);
  for (int i = 0; i < kMostIterations; ++i) {
    const double f = value(c, degree, u);
    if (f == 0) return u;
    ((f > 0) == (value_lo > 0) ? lo : hi) = u;
    const double next = u - f / slope(c, degree, u);
    const double inside = next > lo && next < hi ? next : 0.5 * (lo + hi);
    if (std::abs(inside - u) <= kUnitRounding) return inside;
    u = inside;
  }
  return u;
}

// Roots of c0 + c1 u + c2 u^2 in (0, 1), ascending.
Roots quadratic_roots(const double* c) {
  Roots roots;
  const auto keep = [&](double u) {
    if (u > 0 && u < 1) roots.add(u);
  };
  const double discriminant = c[1] * c[1] - 4 * c[2] * c[0];
  if (discriminant < 0) return roots;
  const double q = -0.5 * (c[1] + std::copysign(std::sqrt(discriminant), c[1]));
  double first = c[2] != 0 ? q / c[2] : -1, second = q != 0 ? c[0] / q : -1;
  if (first > second) std::swap(first, second);
  keep(first);
  if (second != first) keep(second);
  return roots;
}

// Roots of a polynomial in (0, 1), given those of its derivative.
Roots roots_between(const double* c, int degree, const Roots& turns) {
  Roots roots;
  double lo = 0, value_lo = c[0];
  for (int i = 0; i <= turns.count; ++i) {
    const double hi = i < turns.count ? turns.at[static_cast<size_t>(i)] : 1.0;
    const double value_hi = value(c, degree, hi);
    if ((value_lo > 0) != (value_hi > 0)) roots.add(bracketed_root(c, degree, lo, hi, value_lo));
    lo = hi;
    value_lo = value_hi;
  }
  return roots;
}

}  // namespace

std::optional<double> first_descent(const Quartic& c) {
  const std::array<double, 4> first{c[1], 2 * c[2], 3 * c[3], 4 * c[4]};
  const std::array<double, 3> second{2 * c[2], 6 * c[3], 12 * c[4]};
  const Roots turns = roots_between(first.data(), 3, quadratic_roots(second.data()));
  double lo = 0, value_lo = c[0];
  for (int i = 0; i <= turns.count; ++i) {
    const double hi = i < turns.count ? turns.at[static_cast<size_t>(i)] : 1.0;
    const double value_hi = value(c.data(), 4, hi);
    if (value_lo > 0 && value_hi <= 0) return bracketed_root(c.data(), 4, lo, hi, value_lo);
    lo = hi;
    value_lo = value_hi;
  }
  return std::nullopt;
}

}  // namespace synth
}  // namespace walktrack
