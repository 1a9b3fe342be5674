// Limit cycles of any return map x -> P(x) of a section: fixed points by Newton's method, their
// Floquet multipliers, and continuation in a parameter. Knows nothing of walkers.
//
// Newton works in an orthonormal basis N of the section's tangent space (the null space of `rows`):
//   (I - A) d = N'(P(x) - x),  A = N' DP(x) N by central differences,
// and takes the part of x off the tangent space from the image P(x), which lies on the section.
// The multipliers are the eigenvalues of A.
#pragma once

#include <functional>
#include <optional>

#include <Eigen/Core>

namespace walktrack {

// nullopt: the map is not defined here (the walker fell).
using ReturnMap = std::function<std::optional<Eigen::VectorXd>(const Eigen::VectorXd&)>;
// Rows that tangent vectors of the section at x are orthogonal to (may have none).
using SectionRows = std::function<Eigen::MatrixXd(const Eigen::VectorXd&)>;

struct CycleOptions {
  int max_iterations = 40;
  int max_halvings = 12;          // of a Newton step that leads too far
  double tolerance = 1e-10;       // of |P(x) - x|
  double difference_step = 1e-5;  // maps located to 1e-12 leave 1e-7 in a multiplier
};

struct LimitCycle {
  Eigen::VectorXd point;
  double residual = 0;           // |P(x) - x|
  Eigen::MatrixXd basis;         // N
  Eigen::MatrixXd jacobian;      // A
  Eigen::VectorXcd multipliers;  // by falling modulus
  int iterations = 0;
  double largest_multiplier() const;
  bool is_stable() const { return largest_multiplier() < 1; }
};

// nullopt: no fixed point was reached from `guess`.
std::optional<LimitCycle> find_limit_cycle(const ReturnMap& map, const SectionRows& rows,
                                           const Eigen::VectorXd& guess,
                                           const CycleOptions& options = {});

// Orthonormal basis of the null space of `rows` in dimension n.
Eigen::MatrixXd null_space(const Eigen::MatrixXd& rows, Eigen::Index n);

// A family of maps over one parameter.
struct MapFamily {
  std::function<ReturnMap(double)> map;
  std::function<SectionRows(double)> rows;
  // Moves a predicted point onto the section of another parameter, e.g. to a prescribed energy;
  // nullopt where it cannot be. Empty: every section holds all points.
  std::function<std::optional<Eigen::VectorXd>(double, const Eigen::VectorXd&)> onto = {};
};

struct FollowedCycle {
  std::optional<LimitCycle> cycle;  // the last one found; none: the guess leads to none
  double reached = 0;               // its parameter
  bool arrived = false;             // reached == to; else a fold, or the walker falls
};

// The cycle at `to`, followed from the one near `guess` at `from` by a secant predictor whose step
// is halved where Newton fails.
FollowedCycle follow_limit_cycle(const MapFamily& family, const Eigen::VectorXd& guess, double from,
                                 double to, const CycleOptions& options = {});

}  // namespace walktrack
