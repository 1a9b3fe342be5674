// A subject as a tree of rigid links that fits a motion: pelvis, trunk with head, thighs, shanks,
// feet and, if the motion has them, upper arms and forearms with hands, connected by ball joints.
// Its states follow from joint centres and are used by mechanics/articulated_dynamics.h.
//
// Masses, centres of mass and radii of gyration: Winter, "Biomechanics and Motor Control of Human
// Movement", 4th ed. 2009, table 4.1; solids where the table has no radius (trunk, pelvis, head).
// Arms that were not tracked hang from the trunk. Lengths are the motion's own (means over its
// rows). Link axes: z up along the link, y to the left, x forward; a foot's x points from ankle to
// toe. The root is the pelvis, with its origin at the midpoint of the hips. Metres, kilograms,
// world axes.
#pragma once

#include <vector>

#include <Eigen/Core>

#include "body/body.h"
#include "body/motion.h"
#include "mechanics/articulated.h"

namespace walktrack {
inline namespace kinetics {

struct Link {
  Segment segment;
  Joint origin;
};

struct LinkedBody {
  ArticulatedBody tree;
  std::vector<Link> links;  // one for each part of the tree
  size_t index(Segment segment) const;
};

// Whether the joints that links need are known: pelvis, neck or head, hips to toes.
bool linkable(const JointPositions& joints);

// `joints`: at least one row, all with these joints. Arms are separate links if every row has them.
LinkedBody linked_body(const Subject& subject, std::span<const JointPositions> joints);

// Position, velocity and acceleration of every row by central differences of second order; the
// first and the last row have the derivatives of their neighbours. At least 3 rows, `dt` apart.
struct LinkedState {
  Eigen::VectorXd q, u, u_dot;  // as in mechanics/articulated.h
};
std::vector<LinkedState> linked_states(const LinkedBody& body,
                                       std::span<const JointPositions> joints, double dt);

}  // namespace kinetics
}  // namespace walktrack
