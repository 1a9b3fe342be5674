// Alternatives to the kernels: other ways to compute the same.
#pragma once

#include <array>
#include <memory>

#include "observation/silhouette/capsules.h"
#include "observation/silhouette/planes.h"
#include "walker/kneed/kneed_points.h"

namespace walktrack {

// Forward dynamics of the kneed walker as in textbooks: with the parts' Jacobian T (15x5) and the
// diagonal M, (T'MT) qdd = T'(f - M dT/dt qd) + torques, Eigen and its Cholesky factorisation.
struct TmtWalker {
  explicit TmtWalker(const KneedModel& model);
  Vector5 accelerations(const KneedControls& controls, const KneedState& state) const;

  std::array<KneedPoint, 5> centres;
  std::array<double, 5> masses;
  Eigen::Matrix<double, 15, 1> part_masses;
  Vector2 gravity;
  double foot_radius;
};

// A planar biped of five links in MuJoCo, with its stance foot hinged to the ground, joints with
// springs and dampers, without contacts: one evaluation of its accelerations.
class MujocoBiped {
 public:
  MujocoBiped();  // throws std::runtime_error if MuJoCo refuses the model
  ~MujocoBiped();
  // Joint angles and rates; returns an acceleration.
  double evaluate(const Vector5& q, const Vector5& qd);

 private:
  struct World;
  std::unique_ptr<World> world_;
};

// The sum over the visible silhouette by testing every pixel of every part's bounding box.
double per_pixel_silhouette(const LogRatioPlanes& planes, const CapsuleList& capsules);

}  // namespace walktrack
