#include "mechanics/tmt.h"

#include "core/dense.h"

namespace walktrack {
inline namespace mechanics {

using Eigen::MatrixXd;
using Eigen::VectorXd;

TmtSystem assemble_tmt(const MatrixXd& part_mass, const MatrixXd& T, const VectorXd& convective,
                       const VectorXd& part_force) {
  const MatrixXd weighted = part_mass * T;
  return {T.transpose() * weighted, T.transpose() * part_force - weighted.transpose() * convective};
}

VectorXd solve_mass(const MatrixXd& mass, const VectorXd& force) {
  return solve_positive(mass, force);
}

}  // namespace mechanics
}  // namespace walktrack
