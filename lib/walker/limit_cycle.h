// Limit cycles of any return map x -> P(x) of a section: fixed points by Newton's method, their
// Floquet multipliers, and continuation in a parameter. Knows nothing of walkers.
//
// Newton works in an orthonormal basis N of the section's tangent space (the null space of `rows`):
//   (I - A) d = N'(P(x) - x),  A = N' DP(x) N by central differences,
// and takes the part of x off the tangent space from the image P(x), which lies on the section.
// Where a section has a quantity that is conserved, curved and neutral (an energy), steps would
// drift off it: there every iterate and every image is moved back by `onto`. The multipliers are
// the eigenvalues of A.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace walktrack {
inline namespace walker {

// nullopt: the map is not defined here (the walker fell).
using ReturnMap = std::function<std::optional<Eigen::VectorXd>(const Eigen::VectorXd&)>;
// Rows that tangent vectors of the section at x are orthogonal to (may have none).
using SectionRows = std::function<Eigen::MatrixXd(const Eigen::VectorXd&)>;
// A point near the section moved onto it; nullopt where it cannot be. Empty: maps stay on it.
using SectionProjection = std::function<std::optional<Eigen::VectorXd>(const Eigen::VectorXd&)>;

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
                                           const CycleOptions& options = {},
                                           const SectionProjection& onto = {});

// A family of maps over one parameter.
struct MapFamily {
  std::function<ReturnMap(double)> map;
  std::function<SectionRows(double)> rows;
  // Onto the section of a parameter, e.g. to a prescribed energy. Empty: sections hold all points.
  std::function<SectionProjection(double)> onto = {};
};

// Two neighbouring values of the parameter between which the cycle that was found is no
// continuation of the one before.
struct BranchChange {
  double from = 0, to = 0;
};

struct FollowedCycle {
  std::optional<LimitCycle> cycle;  // the last one found; none: the guess leads to none
  double reached = 0;               // its parameter
  bool arrived = false;             // reached == to; else a fold, or the walker falls
  std::vector<BranchChange> changes{};
};

// The cycle at `to`, followed from the one near `guess` at `from` by a secant predictor whose step
// is halved where Newton fails, and where it leads elsewhere than predicted: to another point, or
// to other multipliers. What does not even continue over the smallest step has changed its branch.
FollowedCycle follow_limit_cycle(const MapFamily& family, const Eigen::VectorXd& guess, double from,
                                 double to, const CycleOptions& options = {});

}  // namespace walker
}  // namespace walktrack
