// Limit cycles of any return map x -> P(x) of a section: fixed points by Newton's method, their
// Floquet multipliers, and continuation in a parameter. It is independent of walkers.
//
// Newton works in an orthonormal basis N of the section's tangent space (the null space of `rows`):
//   (I - A) d = N'(P(x) - x),  A = N' DP(x) N by central differences,
// and takes the part of x off the tangent space from the image P(x), which is on the section. If a
// section has a conserved quantity that is curved and neutral (an energy), steps would drift: then
// every iterate and every image is projected by `onto`. The multipliers are the eigenvalues of A.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include <Eigen/Core>

namespace walktrack {
inline namespace walker {

// nullopt: the map is undefined here (the walker fell).
using ReturnMap = std::function<std::optional<Eigen::VectorXd>(const Eigen::VectorXd&)>;
// Rows to which tangent vectors of the section at x are orthogonal (may be empty).
using SectionRows = std::function<Eigen::MatrixXd(const Eigen::VectorXd&)>;
// Projects a point near the section onto it; nullopt if that is impossible. Empty: maps stay on the
// section.
using SectionProjection = std::function<std::optional<Eigen::VectorXd>(const Eigen::VectorXd&)>;

struct CycleOptions {
  int max_iterations = 40;
  int max_halvings = 12;          // of a Newton step that is too long
  double tolerance = 1e-10;       // of |P(x) - x|
  double difference_step = 1e-5;  // maps with an error of 1e-12 then give an error of 1e-7 in a
                                  // multiplier
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

// nullopt: no fixed point was found from `guess`.
std::optional<LimitCycle> find_limit_cycle(const ReturnMap& map, const SectionRows& rows,
                                           const Eigen::VectorXd& guess,
                                           const CycleOptions& options = {},
                                           const SectionProjection& onto = {});

// A family of maps over one parameter.
struct MapFamily {
  std::function<ReturnMap(double)> map;
  std::function<SectionRows(double)> rows;
  // The projection onto the section for a parameter, e.g. to a prescribed energy. Empty: none.
  std::function<SectionProjection(double)> onto = {};
};

// Two neighbouring values of the parameter between which the cycle that was found does not continue
// the previous one.
struct BranchChange {
  double from = 0, to = 0;
};

struct FollowedCycle {
  std::optional<LimitCycle> cycle;  // the last one found; nullopt: none was found from the guess
  double reached = 0;               // its parameter
  bool arrived = false;             // reached == to; otherwise there was a fold, or the walker fell
  std::vector<BranchChange> changes{};
};

// The cycle at `to`, continued from the one near `guess` at `from` by a secant predictor whose step
// is halved if Newton's method fails, and if the result differs from the prediction: another point,
// or other multipliers. If that happens even for the smallest step, the branch has changed.
FollowedCycle follow_limit_cycle(const MapFamily& family, const Eigen::VectorXd& guess, double from,
                                 double to, const CycleOptions& options = {});

}  // namespace walker
}  // namespace walktrack
