// Articulated bodies for the tests: a branched body with every kind of joint, and a plain chain.
#pragma once

#include <vector>

#include "mechanics/articulated.h"
#include "tests/mechanics/random_state.h"

namespace walktrack {

inline ArticulatedPart sample_part(Rng& rng, int parent, JointKind joint) {
  ArticulatedPart part;
  part.mass = transformed(elliptic_frustum(1000, 0.4, {0.08, 0.06}, {0.05, 0.07}),
                          rotation_matrix(random_quaternion(rng)), random_vector(rng, 3, 0.1));
  part.parent = parent;
  part.joint = joint;
  part.anchor = random_vector(rng, 3, 0.3);
  part.axis = Eigen::Vector3d(random_vector(rng, 3)).normalized();
  part.rest = random_quaternion(rng);
  return part;
}

// Root, ball, hinge, fixed, and a second branch of hinge and ball: 6 + 3 + 1 + 0 + 1 + 3
// velocities.
inline ArticulatedBody sample_body() {
  Rng rng(21, Purpose::kTest);
  std::vector<ArticulatedPart> parts;
  parts.push_back(sample_part(rng, -1, JointKind::kFixed));
  parts.push_back(sample_part(rng, 0, JointKind::kBall));
  parts.push_back(sample_part(rng, 1, JointKind::kHinge));
  parts.push_back(sample_part(rng, 2, JointKind::kFixed));
  parts.push_back(sample_part(rng, 0, JointKind::kHinge));
  parts.push_back(sample_part(rng, 4, JointKind::kBall));
  return ArticulatedBody(std::move(parts));
}

inline Eigen::VectorXd random_positions(const ArticulatedBody& body, Rng& rng) {
  return body.with_unit_quaternions(random_vector(rng, body.positions()));
}

}  // namespace walktrack
