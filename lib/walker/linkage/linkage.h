// Walkers with rolling feet: rimless wheel, straight-legged and kneed walkers are all linkages of
// rigid parts around a hip, assembled by mechanics/planar.h from tables of points. This header
// defines the table, linkage_walker.h the walker, and models.h fills tables.
#pragma once

#include <string>
#include <vector>

#include "mechanics/limits.h"
#include "mechanics/planar.h"

namespace walktrack {
inline namespace walker {

// A spring and damper, or an actuator: generalised force = pull * tau,
//   tau = stiffness (rest - measure . q) - damping measure . qd.
// If pull = measure it has a potential; otherwise it is an actuator (the torso's law measures the
// angle to the vertical, and its reaction acts on a thigh).
struct LinkageSpring {
  Eigen::VectorXd measure, pull;
  double stiffness = 0;  // N m/rad
  double damping = 0;    // N m s/rad
  double rest = 0;       // rad
};

// Parts and points relative to the hip, as functions of n angles.
struct Linkage {
  std::vector<std::string> angles;  // names of the coordinates
  std::vector<PlanarPart> parts;    // com relative to the hip
  PlanarPoint stance_foot{0};       // arc centre of the stance foot relative to the hip
  PlanarPoint swing_foot{0};
  Eigen::Index stance_angle = 0;  // angle of the part that carries the foot
  Eigen::Index swing_angle = 0;
  double foot_radius = 0;  // m
  Eigen::Vector2d gravity = {0, -9.80665};

  // Support transfer: q_new(i) = q_old(exchange[i]) + shift(i).
  std::vector<Eigen::Index> exchange;
  Eigen::VectorXd shift;

  std::vector<LinkageSpring> springs;
  double toe_off_impulse = 0;  // N s, at the old foot's arc centre towards the hip

  // Limits a . q >= b: first the knee stops (stance, swing), then others.
  std::vector<Limit> limits;
  // Latched walkers: the stance knee is rigid; the swing knee becomes rigid at its stop, and both
  // remain so through the strike; then the new swing knee is released. Limits 0 and 1 are then the
  // knees.
  bool latched = false;

  bool may_scuff = false;  // whether the swing foot may pass below the ground (straight legs)
  bool may_fly = false;    // whether the stance foot is released when the ground would pull
  double lowest_hip = 0;   // m; a walker with a lower hip has fallen

  struct Line {
    PlanarPoint from, to;  // relative to the hip
    int group = 0;
  };
  std::vector<Line> lines;  // what is drawn
};

}  // namespace walker
}  // namespace walktrack
