// Generalised coordinates u (the TMT method): parts' coordinates x = x(u), T = dx/du, constant part
// masses M,
//   (T^T M T) u_ddot = T^T (f - M Td ud) + generalised forces.
// All models of the library use this assembly: planar.h computes T for planar linkages,
// articulated.h for bodies in 3-D.
#pragma once

#include <Eigen/Core>

namespace walktrack {
inline namespace mechanics {

struct TmtSystem {
  Eigen::MatrixXd mass;   // T^T M T, n x n
  Eigen::VectorXd force;  // T^T (f - M Td ud), n
};

// part_mass r x r, T r x n, convective (Td ud) r, part_force f r.
TmtSystem assemble_tmt(const Eigen::MatrixXd& part_mass, const Eigen::MatrixXd& T,
                       const Eigen::VectorXd& convective, const Eigen::VectorXd& part_force);

// M^-1 f for a symmetric positive definite M, which may be badly scaled (parts of very unequal
// mass).
Eigen::VectorXd solve_mass(const Eigen::MatrixXd& mass, const Eigen::VectorXd& force);

}  // namespace mechanics
}  // namespace walktrack
