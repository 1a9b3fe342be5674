// The kneed walker (Brubaker & Fleet, "The Kneed Walker for Human Pose Tracking", CVPR 2008): a
// torso, two thighs and two shanks with rounded feet that move in one vertical plane. This is the
// hand-written kernel for particles: closed forms, fixed sizes, no heap.
//
// Reduced coordinates are the absolute angles q = (torso, stance thigh, swing thigh, stance shank,
// swing shank); positive leans the upper end forward (core/conventions.h). With u(a) = (sin a, cos
// a) and w(a) = (cos a, -sin a) every point of the walker is
//   p = (x0 + R q3, R) + sum_k [ along_k u(q_k) + across_k w(q_k) ],
// because the stance foot's arc centre (x0 + R q3, R) rolls without slip. The arc centre lies `up`
// above the ankle and `forward` of the shank's axis. The ground is z = 0; a slope tilts gravity.
//
// Integration over time, knee stops and support transfer are in kneed_advance.h.
#pragma once

#include <Eigen/Core>
#include <array>

namespace walktrack {
inline namespace walker {

using Vector2 = Eigen::Vector2d;
using Vector5 = Eigen::Matrix<double, 5, 1>;
using Matrix5 = Eigen::Matrix<double, 5, 5>;

enum KneedAngle { kTorso, kStanceThigh, kSwingThigh, kStanceShank, kSwingShank };

struct KneedTorso {
  double mass = 0;           // kg
  double com_above_hip = 0;  // m
  double inertia = 0;        // kg m^2 about the centre of mass, as for the other parts
};
struct KneedThigh {
  double mass = 0;
  double com_below_hip = 0;  // m
  double inertia = 0;
};
struct KneedShank {
  double mass = 0;             // with the foot
  double com_above_ankle = 0;  // m, along the shank
  double com_forward = 0;      // m, forward of its axis
  double inertia = 0;
};

struct KneedParameters {
  double gravity = 9.80665;  // m/s^2
  double slope = 0;          // rad, positive downhill
  double thigh_length = 0;   // m
  double shank_length = 0;   // m, knee to ankle
  double foot_radius = 0;    // m
  double foot_forward = 0;   // m, arc centre ahead of the shank's axis
  double foot_up = 0;        // m, arc centre above the ankle
  KneedTorso torso;
  KneedThigh thigh;
  KneedShank shank;
};

struct SpringDamper {
  double stiffness = 0;  // N m/rad
  double damping = 0;    // N m s/rad
  double rest = 0;       // rad
};

// Constant from one support transfer to the next.
struct KneedControls {
  SpringDamper torso;          // against the vertical, reacts on the stance thigh
  SpringDamper hip;            // on stance thigh - swing thigh
  SpringDamper stance_knee;    // on the knee's flexion, shank - thigh
  SpringDamper swing_knee;     //
  double toe_off_impulse = 0;  // N s, at the transfer that ends the step
};

struct KneedState {
  Vector5 q = Vector5::Zero();   // rad
  Vector5 qd = Vector5::Zero();  // rad/s
  bool stance_stop = false;      // the knee rests on its stop, where flexion is 0
  bool swing_stop = false;
  double contact_x = 0;       // m, x0: the ground point below the arc centre at q3 = 0
  double since_transfer = 0;  // s
  double clearance = 1;       // m, least local minimum of the swing foot's height since then
  int transfers = 0;          // number of support transfers
  int hasty_transfers = 0;    // number of the last transfers that followed each other at once
};

// Parameters with the sums over the parts that the dynamics needs:
// couple_jk = sum_i m_i (along_ij along_ik + across_ij across_ik) (+ inertia on the diagonal),
// skew_jk = sum_i m_i (along_ij across_ik - across_ij along_ik), moments sum_i m_i along_ij.
struct KneedModel {
  KneedParameters parameters;
  double total_mass = 0;                    // kg
  Vector2 gravity = Vector2::Zero();        // m/s^2
  Vector5 along_moment = Vector5::Zero();   // kg m
  Vector5 across_moment = Vector5::Zero();  // kg m
  Matrix5 couple = Matrix5::Zero();         // kg m^2
  Matrix5 skew = Matrix5::Zero();           // kg m^2
};

KneedModel kneed_model(const KneedParameters& parameters);

// Hip height of the upright straight-legged walker, m.
double standing_hip_height(const KneedParameters& parameters);

Matrix5 kneed_mass_matrix(const KneedModel& model, const Vector5& q);

// Generalised torques of the springs and dampers, N m.
Vector5 kneed_torques(const KneedControls& controls, const Vector5& q, const Vector5& qd);

struct KneedAcceleration {
  Vector5 qdd = Vector5::Zero();        // rad/s^2
  std::array<double, 2> stop_torque{};  // N m, stance and swing knee; positive pushes into flexion
};

// Solves M qdd = torques + noise - Coriolis + gravity, with constant flexion of every knee whose
// stop is active (the augmented system). `noise` is a generalised torque, N m.
KneedAcceleration kneed_accelerations(const KneedModel& model, const KneedControls& controls,
                                      const Vector5& noise, const KneedState& state);

// Kinetic and potential energy, J. The potential is zero at the origin of the ground frame and does
// not include the springs.
struct KneedEnergy {
  double kinetic = 0;
  double potential = 0;
};
KneedEnergy kneed_energy(const KneedModel& model, const KneedState& state);

// Ground reaction on the stance foot (forward, up), N, for given accelerations.
Vector2 kneed_contact_force(const KneedModel& model, const KneedState& state, const Vector5& qdd);

// Points in the plane of walking (x forward, z up), m. They are continuous through a transfer, at
// which stance and swing leg swap. `foot` is the arc centre; the sole touches the ground at R below
// it.
struct KneedPosture {
  Vector2 stance_foot, stance_ankle, stance_knee, hip, torso_com, swing_knee, swing_ankle,
      swing_foot;
};
KneedPosture kneed_posture(const KneedModel& model, const KneedState& state);

// Lowest point of the swing foot's arc: height above the ground and distance in front of the stance
// foot, m, with their rates, m/s.
struct SwingFoot {
  double height = 0, lead = 0, height_rate = 0, lead_rate = 0;
};
SwingFoot kneed_swing_foot(const KneedModel& model, const KneedState& state);

// Support transfer with toe-off: (B+' H B+) qd+ = B+' (H B- qd- + S). The toe-off impulse acts on
// the old stance foot at its arc centre towards the hip; the new stance foot sticks and rolls.
// Afterwards stance and swing leg swap. Knee stops are not part of it (see settle_knee_stops).
struct KneedTransfer {
  KneedState state;
  Vector2 impulse;  // of the ground on the new stance foot, N s
};
KneedTransfer kneed_support_transfer(const KneedModel& model, double toe_off_impulse,
                                     const KneedState& before);

}  // namespace walker
}  // namespace walktrack
