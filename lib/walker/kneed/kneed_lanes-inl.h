// The kneed walker's dynamics for a vector of walkers, one in each lane; included by
// kneed_lanes.cpp once for every instruction set (as Highway requires, hence the guard).
//
// Coordinates are (torso, stance thigh, swing thigh, stance flexion, swing flexion), and rates
// likewise: a knee at its stop then is a constant coordinate, so that its row of the equations
// becomes "acceleration = 0" in that lane and nothing else changes.
//
// Equations. For every pair of parts of which one carries the other, with P_j = (u_j, v_j) the link
// of the inner part rotated by its angle and (x_k, z_k) the outer part's first moment rotated by
// its angle,
//   M_jk = u_j x_k + v_j z_k,   pull_jk = u_j z_k - v_j x_k,
//   force_j += pull_jk qd_k^2,  force_k -= pull_jk qd_j^2
// (kneed_walker.cpp: couple_jk + i skew_jk is the product of link and moment as complex numbers).
// The stance shank carries all other parts, the stance thigh all except the shank, the swing thigh
// its shank; torso and swing leg are not coupled. If it is eliminated from the leaves inwards, the
// matrix keeps its zeros (Featherstone, "Rigid Body Dynamics Algorithms", 2008, section 6.5).
#if defined(WALKTRACK_KNEED_LANES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WALKTRACK_KNEED_LANES_H
#undef WALKTRACK_KNEED_LANES_H
#else
#define WALKTRACK_KNEED_LANES_H
#endif

#include "walker/lanes/lanes-inl.h"

HWY_BEFORE_NAMESPACE();
namespace walktrack {
inline namespace walker {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Motion = MotionOf<5>;  // in the coordinates above

// Values that are constant within a step.
struct Setting {
  const LaneModel& model;
  const LaneForces& forces;
  Mask held[2];  // knees at their stops
};

// Results of an evaluation at a state, besides accelerations.
struct Surroundings {
  V stop_torque[2];                  // N m, of held knees; 0 elsewhere
  V height, lead, height_rate, hip;  // SwingFoot, and the hip's height, m
};

// Absolute angles or rates.
HWY_INLINE void add_flexions(const V (&relative)[5], V (&absolute)[5]) {
  for (int k = 0; k < 3; ++k) absolute[k] = relative[k];
  absolute[3] = hn::Add(relative[1], relative[3]);
  absolute[4] = hn::Add(relative[2], relative[4]);
}

// The symmetric mass matrix, lower triangle in the order of elimination: row j contains its
// diagonal and the elements for the parts that carry it.
struct Equations {
  V m00, m01, m03;
  V m44, m42, m41, m43;
  V m22, m21, m23;
  V m11, m13;
  V m33;
  V f[5];
};

struct Turned {
  V c[5], s[5];      // of absolute angles
  V u3, v3, u4, v4;  // links of stance and swing shank; a thigh's are (l cos, l sin)
  V x[5], z[5];      // first moments
};

HWY_INLINE Turned turned(const LaneModel& p, const V (&angle)[5]) {
  Turned t;
  for (int k = 0; k < 5; ++k) {
    const SineCosine sc = sine_cosine(angle[k]);
    t.c[k] = sc.cosine;
    t.s[k] = sc.sine;
  }
  for (int k = 0; k < 3; ++k) {  // torso and thighs have their masses on their axes
    t.x[k] = hn::Mul(all(p.along[k]), t.c[k]);
    t.z[k] = hn::Mul(all(p.along[k]), t.s[k]);
  }
  for (int k = 3; k < 5; ++k) {
    t.x[k] = hn::NegMulAdd(all(p.across[k]), t.s[k], hn::Mul(all(p.along[k]), t.c[k]));
    t.z[k] = hn::MulAdd(all(p.across[k]), t.c[k], hn::Mul(all(p.along[k]), t.s[k]));
  }
  const V l = all(p.shank_along), a = all(p.shank_across);
  t.u3 = hn::NegMulAdd(a, t.s[3], hn::Mul(l, t.c[3]));
  t.v3 = hn::MulAdd(a, t.c[3], hn::Mul(l, t.s[3]));
  t.u4 = hn::NegMulAdd(a, t.s[4], hn::Mul(l, t.c[4]));
  t.v4 = hn::MulAdd(a, t.c[4], hn::Mul(l, t.s[4]));
  return t;
}

// In relative coordinates, mass matrix only: M' = T' M T with columns thigh + shank, shank.
HWY_INLINE void to_flexions(Equations& e) {
  using hn::Add;
  e.m41 = Add(e.m41, e.m43);
  e.m21 = Add(e.m21, e.m23);
  e.m01 = Add(e.m01, e.m03);
  e.m11 = Add(e.m11, Add(e.m13, Add(e.m13, e.m33)));
  e.m13 = Add(e.m13, e.m33);
  e.m21 = Add(e.m21, e.m41);
  e.m23 = Add(e.m23, e.m43);
  e.m22 = Add(e.m22, Add(e.m42, Add(e.m42, e.m44)));
  e.m42 = Add(e.m42, e.m44);
  e.f[1] = Add(e.f[1], e.f[3]);
  e.f[2] = Add(e.f[2], e.f[4]);
}

// Gravity, Coriolis forces and the mass matrix, without torques.
HWY_INLINE Equations equations(const LaneModel& p, const Turned& t, const V (&rate)[5]) {
  const V radius = all(p.radius);
  V square[5];
  Equations e;
  for (int k = 0; k < 5; ++k) {
    square[k] = hn::Mul(rate[k], rate[k]);
    e.f[k] = hn::NegMulAdd(all(p.gravity_z), t.z[k], hn::Mul(all(p.gravity_x), t.x[k]));
  }
  const auto couple = [&](int j, int k, V u, V v) {
    const V pull = hn::NegMulAdd(v, t.x[k], hn::Mul(u, t.z[k]));
    e.f[k] = hn::NegMulAdd(pull, square[j], e.f[k]);
    e.f[j] = hn::MulAdd(j == 3 ? hn::MulAdd(radius, t.z[k], pull) : pull, square[k], e.f[j]);
    return hn::MulAdd(v, t.z[k], hn::Mul(j == 3 ? hn::Add(u, radius) : u, t.x[k]));
  };
  const V thigh = all(p.thigh);
  const V u1 = hn::Mul(thigh, t.c[1]), v1 = hn::Mul(thigh, t.s[1]);
  const V u2 = hn::Mul(all(-p.thigh), t.c[2]), v2 = hn::Mul(all(-p.thigh), t.s[2]);
  e.m43 = couple(3, 4, t.u3, t.v3);
  e.m23 = couple(3, 2, t.u3, t.v3);
  e.m03 = couple(3, 0, t.u3, t.v3);
  e.m13 = couple(3, 1, t.u3, t.v3);
  e.m41 = couple(1, 4, u1, v1);
  e.m21 = couple(1, 2, u1, v1);
  e.m01 = couple(1, 0, u1, v1);
  e.m42 = couple(2, 4, u2, v2);
  e.m00 = all(p.diagonal[0]);
  e.m11 = all(p.diagonal[1]);
  e.m22 = all(p.diagonal[2]);
  e.m33 = hn::MulAdd(all(2 * p.radius), t.x[3], all(p.diagonal[3] + p.radius * p.radius * p.mass));
  e.m44 = all(p.diagonal[4]);
  e.f[3] = hn::Add(hn::MulAdd(hn::Mul(radius, t.z[3]), square[3], e.f[3]),
                   all(p.radius * p.gravity_x * p.mass));
  to_flexions(e);
  return e;
}

// Springs and dampers: torque = offset - stiffness angle - damping rate, offset = stiffness rest.
HWY_INLINE void add_torques(const LaneForces& forces, const Motion& motion, Equations& e) {
  const Tag d;
  const auto resisting = [&](size_t i, V angle, V rate) {
    const V spring =
        hn::NegMulAdd(hn::Load(d, forces.stiffness[i]), angle, hn::Load(d, forces.offset[i]));
    return hn::NegMulAdd(hn::Load(d, forces.damping[i]), rate, spring);
  };
  const V torso = resisting(0, motion.q[0], motion.qd[0]);
  const V hip =
      resisting(1, hn::Sub(motion.q[1], motion.q[2]), hn::Sub(motion.qd[1], motion.qd[2]));
  for (size_t k = 0; k < 5; ++k) e.f[k] = hn::Add(e.f[k], hn::Load(d, forces.noise[k]));
  e.f[0] = hn::Add(e.f[0], torso);
  e.f[1] = hn::Add(e.f[1], hn::Sub(hip, torso));
  e.f[2] = hn::Sub(e.f[2], hip);
  e.f[3] = hn::Add(e.f[3], resisting(2, motion.q[3], motion.qd[3]));
  e.f[4] = hn::Add(e.f[4], resisting(3, motion.q[4], motion.qd[4]));
}

HWY_INLINE void hold(const Mask (&held)[2], Equations& e) {
  e.m13 = hn::IfThenZeroElse(held[0], e.m13);
  e.m03 = hn::IfThenZeroElse(held[0], e.m03);
  e.m23 = hn::IfThenZeroElse(held[0], e.m23);
  e.m43 = hn::IfThenZeroElse(hn::Or(held[0], held[1]), e.m43);
  e.m33 = hn::IfThenElse(held[0], all(1), e.m33);
  e.f[3] = hn::IfThenZeroElse(held[0], e.f[3]);
  e.m42 = hn::IfThenZeroElse(held[1], e.m42);
  e.m41 = hn::IfThenZeroElse(held[1], e.m41);
  e.m44 = hn::IfThenElse(held[1], all(1), e.m44);
  e.f[4] = hn::IfThenZeroElse(held[1], e.f[4]);
}

struct Pivots {
  V inverse[5];
};

// Eliminates the leaves from the matrix, in place: row j then contains its factors times its pivot.
// `forward` does the same to a right-hand side.
HWY_INLINE Pivots eliminate(Equations& e) {
  Pivots p;
  p.inverse[4] = hn::Div(all(1), e.m44);
  p.inverse[0] = hn::Div(all(1), e.m00);
  const V l2 = hn::Mul(e.m42, p.inverse[4]), l1 = hn::Mul(e.m41, p.inverse[4]);
  const V l3 = hn::Mul(e.m43, p.inverse[4]);
  e.m22 = hn::NegMulAdd(l2, e.m42, e.m22);
  e.m21 = hn::NegMulAdd(l2, e.m41, e.m21);
  e.m23 = hn::NegMulAdd(l2, e.m43, e.m23);
  e.m11 = hn::NegMulAdd(l1, e.m41, e.m11);
  e.m13 = hn::NegMulAdd(l1, e.m43, e.m13);
  e.m33 = hn::NegMulAdd(l3, e.m43, e.m33);
  const V k1 = hn::Mul(e.m01, p.inverse[0]), k3 = hn::Mul(e.m03, p.inverse[0]);
  e.m11 = hn::NegMulAdd(k1, e.m01, e.m11);
  e.m13 = hn::NegMulAdd(k1, e.m03, e.m13);
  e.m33 = hn::NegMulAdd(k3, e.m03, e.m33);
  p.inverse[2] = hn::Div(all(1), e.m22);
  const V j1 = hn::Mul(e.m21, p.inverse[2]), j3 = hn::Mul(e.m23, p.inverse[2]);
  e.m11 = hn::NegMulAdd(j1, e.m21, e.m11);
  e.m13 = hn::NegMulAdd(j1, e.m23, e.m13);
  e.m33 = hn::NegMulAdd(j3, e.m23, e.m33);
  p.inverse[1] = hn::Div(all(1), e.m11);
  e.m33 = hn::NegMulAdd(hn::Mul(e.m13, p.inverse[1]), e.m13, e.m33);
  p.inverse[3] = hn::Div(all(1), e.m33);
  return p;
}

HWY_INLINE void forward(const Equations& e, const Pivots& p, V (&f)[5]) {
  const V f4 = hn::Mul(f[4], p.inverse[4]), f0 = hn::Mul(f[0], p.inverse[0]);
  f[2] = hn::NegMulAdd(e.m42, f4, f[2]);
  f[1] = hn::NegMulAdd(e.m01, f0, hn::NegMulAdd(e.m41, f4, f[1]));
  f[3] = hn::NegMulAdd(e.m03, f0, hn::NegMulAdd(e.m43, f4, f[3]));
  const V f2 = hn::Mul(f[2], p.inverse[2]);
  f[1] = hn::NegMulAdd(e.m21, f2, f[1]);
  f[3] = hn::NegMulAdd(e.m23, f2, f[3]);
  f[3] = hn::NegMulAdd(e.m13, hn::Mul(f[1], p.inverse[1]), f[3]);
}

HWY_INLINE void backward(const Equations& e, const Pivots& p, const V (&f)[5], V (&x)[5]) {
  x[3] = hn::Mul(f[3], p.inverse[3]);
  x[1] = hn::Mul(hn::NegMulAdd(e.m13, x[3], f[1]), p.inverse[1]);
  x[0] = hn::Mul(hn::NegMulAdd(e.m01, x[1], hn::NegMulAdd(e.m03, x[3], f[0])), p.inverse[0]);
  x[2] = hn::Mul(hn::NegMulAdd(e.m21, x[1], hn::NegMulAdd(e.m23, x[3], f[2])), p.inverse[2]);
  x[4] = hn::NegMulAdd(e.m43, x[3], f[4]);
  x[4] = hn::Mul(hn::NegMulAdd(e.m42, x[2], hn::NegMulAdd(e.m41, x[1], x[4])), p.inverse[4]);
}

// Accelerations; with `around` the other results as well.
HWY_INLINE void accelerations(const Setting& at, const Motion& motion, V (&qdd)[5],
                              Surroundings* around = nullptr) {
  V angle[5], rate[5];
  add_flexions(motion.q, angle);
  add_flexions(motion.qd, rate);
  const Turned t = turned(at.model, angle);
  Equations e = equations(at.model, t, rate);
  add_torques(at.forces, motion, e);
  Equations factor = e;
  hold(at.held, factor);
  const Pivots pivots = eliminate(factor);
  forward(factor, pivots, factor.f);
  backward(factor, pivots, factor.f, qdd);
  if (around == nullptr) return;
  // A held knee's own row gives the torque of its stop.
  const V first = hn::MulAdd(e.m43, qdd[4], hn::MulAdd(e.m23, qdd[2], hn::Mul(e.m03, qdd[0])));
  const V second = hn::MulAdd(e.m43, qdd[3], hn::Mul(e.m42, qdd[2]));
  around->stop_torque[0] =
      hn::IfThenElseZero(at.held[0], hn::Sub(hn::MulAdd(e.m13, qdd[1], first), e.f[3]));
  around->stop_torque[1] =
      hn::IfThenElseZero(at.held[1], hn::Sub(hn::MulAdd(e.m41, qdd[1], second), e.f[4]));
  const V thigh = all(at.model.thigh);
  around->height = hn::MulAdd(thigh, hn::Sub(t.c[1], t.c[2]), hn::Sub(t.u3, t.u4));
  around->lead = hn::MulAdd(thigh, hn::Sub(t.s[1], t.s[2]), hn::Sub(t.v3, t.v4));
  const V thighs = hn::Mul(thigh, hn::NegMulAdd(t.s[1], rate[1], hn::Mul(t.s[2], rate[2])));
  around->height_rate = hn::NegMulAdd(t.v3, rate[3], hn::MulAdd(t.v4, rate[4], thighs));
  around->hip = hn::Add(all(at.model.radius), hn::MulAdd(thigh, t.c[1], t.u3));
}

// The sub-step of kneed_step_size(), of free knees.
HWY_INLINE V step_sizes(const LaneModel& model, const LaneForces& forces, const Motion& motion,
                        double max_step) {
  const Tag d;
  V angle[5];
  const V none = hn::Zero(d), still[5] = {none, none, none, none, none};
  add_flexions(motion.q, angle);
  Equations e = equations(model, turned(model, angle), still);
  const Pivots pivots = eliminate(e);
  const V one = all(1), minus = all(-1);
  // The springs' rows: torso, hip, stance knee, swing knee.
  V rows[4][5] = {{one, minus, none, none, none},
                  {none, minus, one, none, none},
                  {none, none, none, one, none},
                  {none, none, none, none, one}};
  V square = none, decay = none;
  for (size_t i = 0; i < 4; ++i) {
    forward(e, pivots, rows[i]);
    V mobility = none;
    for (int k = 0; k < 5; ++k)
      mobility = hn::MulAdd(hn::Mul(rows[i][k], rows[i][k]), pivots.inverse[k], mobility);
    square = hn::MulAdd(hn::Abs(hn::Load(d, forces.stiffness[i])), mobility, square);
    decay = hn::MulAdd(hn::Abs(hn::Load(d, forces.damping[i])), mobility, decay);
  }
  return hn::Min(all(max_step), hn::Div(all(kStepReach), hn::Max(hn::Sqrt(square), decay)));
}

}  // namespace HWY_NAMESPACE
}  // namespace walker
}  // namespace walktrack
HWY_AFTER_NAMESPACE();

#endif
