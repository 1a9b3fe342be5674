// Vector code that the batch kernels share; included by each of them once for every instruction set
// (as Highway requires, hence the guard).
#if defined(WALKTRACK_LANES_H) == defined(HWY_TARGET_TOGGLE)
#ifdef WALKTRACK_LANES_H
#undef WALKTRACK_LANES_H
#else
#define WALKTRACK_LANES_H
#endif

#include <hwy/highway.h>

#include "core/conventions.h"
#include "walker/lanes/lanes.h"

HWY_BEFORE_NAMESPACE();
namespace walktrack {
inline namespace walker {
namespace HWY_NAMESPACE {
namespace hn = hwy::HWY_NAMESPACE;

using Tag = hn::CappedTag<double, kMaxLanes>;
using V = hn::Vec<Tag>;
using Mask = hn::Mask<Tag>;

HWY_INLINE V all(double value) { return hn::Set(Tag(), value); }

struct SineCosine {
  V sine, cosine;
};

// Exact to rounding for |a| < 1e5: a = k pi/2 + r, then the polynomials of fdlibm (Sun
// Microsystems, 1993).
HWY_INLINE SineCosine sine_cosine(V a) {
  const Tag d;
  const hn::RebindToUnsigned<Tag> du;
  const V magic = all(0x1.8p52);  // the lowest bits of the sum are k
  const V sum = hn::MulAdd(a, all(2 / kPi), magic);
  const V k = hn::Sub(sum, magic);
  const V r = hn::NegMulAdd(k, all(6.123233995736766e-17), hn::NegMulAdd(k, all(kPi / 2), a));
  const V z = hn::Mul(r, r);
  V s = hn::MulAdd(z, all(1.58969099521155010221e-10), all(-2.50507602534068634195e-08));
  s = hn::MulAdd(z, s, all(2.75573137070700676789e-06));
  s = hn::MulAdd(z, s, all(-1.98412698298579493134e-04));
  s = hn::MulAdd(z, s, all(8.33333333332248946124e-03));
  s = hn::MulAdd(z, s, all(-1.66666666666666324348e-01));
  s = hn::MulAdd(hn::Mul(z, r), s, r);
  V c = hn::MulAdd(z, all(-1.13596475577881948265e-11), all(2.08757232129817482790e-09));
  c = hn::MulAdd(z, c, all(-2.75573143513906633035e-07));
  c = hn::MulAdd(z, c, all(2.48015872894767294178e-05));
  c = hn::MulAdd(z, c, all(-1.38888888888741095749e-03));
  c = hn::MulAdd(z, c, all(4.16666666666666019037e-02));
  c = hn::MulAdd(z, hn::MulAdd(z, c, all(-0.5)), all(1));
  const auto bits = hn::BitCast(du, sum);
  const Mask odd = hn::RebindMask(d, hn::TestBit(bits, hn::Set(du, 1)));
  const auto sine_sign = hn::ShiftLeft<62>(hn::And(bits, hn::Set(du, 2)));
  const auto cosine_sign =
      hn::ShiftLeft<62>(hn::And(hn::Add(bits, hn::Set(du, 1)), hn::Set(du, 2)));
  return {hn::Xor(hn::IfThenElse(odd, c, s), hn::BitCast(d, sine_sign)),
          hn::Xor(hn::IfThenElse(odd, s, c), hn::BitCast(d, cosine_sign))};
}

template <int kCount>
struct MotionOf {
  V q[kCount], qd[kCount];
};

template <size_t kCount>
HWY_INLINE void load(const LaneRows<kCount>& rows, V (&values)[kCount]) {
  for (size_t k = 0; k < kCount; ++k) values[k] = hn::Load(Tag(), rows[k]);
}

template <size_t kCount>
HWY_INLINE void store(const V (&values)[kCount], LaneRows<kCount>& rows) {
  for (size_t k = 0; k < kCount; ++k) hn::Store(values[k], Tag(), rows[k]);
}

HWY_INLINE void store_if(Mask go, V fresh, double* row) {
  hn::Store(hn::IfThenElse(go, fresh, hn::Load(Tag(), row)), Tag(), row);
}

HWY_INLINE uint64_t bits_of(Mask mask) {
  uint64_t bits = 0;
  hn::StoreMaskBits(Tag(), mask, reinterpret_cast<uint8_t*>(&bits));
  return bits;
}

// The length of every lane's next sub-step: an equal share of the remaining time.
HWY_INLINE V next_step(const LaneGroup& lanes, V& remaining) {
  const Tag d;
  remaining = hn::Sub(hn::Load(d, lanes.duration[0]), hn::Load(d, lanes.elapsed[0]));
  return hn::Div(remaining, hn::Ceil(hn::Div(remaining, hn::Load(d, lanes.step[0]))));
}

// The elapsed time after a sub-step of h: exactly the duration after the last one.
HWY_INLINE V passed(const LaneGroup& lanes, V h, V remaining) {
  const V later = hn::Add(hn::Load(Tag(), lanes.elapsed[0]), h);
  return hn::IfThenElse(hn::Eq(h, remaining), hn::Load(Tag(), lanes.duration[0]), later);
}

// One RK4 step of h; `a1` are the accelerations at `from`. A kernel's accelerations(at, motion,
// qdd) is found in the namespace of `at`.
template <typename Setting, int kCount>
HWY_INLINE void rk4(const Setting& at, const MotionOf<kCount>& from, const V (&a1)[kCount], V h,
                    MotionOf<kCount>& to) {
  const V half = hn::Mul(all(0.5), h), sixth = hn::Mul(all(1.0 / 6), h);
  MotionOf<kCount> stage;
  V a[kCount], rates[kCount], accelerations_sum[kCount];
  const auto stage_at = [&](V step, const V(&v)[kCount], const V(&acceleration)[kCount]) {
    MotionOf<kCount> next;
    for (int k = 0; k < kCount; ++k) {
      next.q[k] = hn::MulAdd(step, v[k], from.q[k]);
      next.qd[k] = hn::MulAdd(step, acceleration[k], from.qd[k]);
    }
    return next;
  };
  stage = stage_at(half, from.qd, a1);
  accelerations(at, stage, a);
  for (int k = 0; k < kCount; ++k) {
    rates[k] = hn::MulAdd(all(2), stage.qd[k], from.qd[k]);
    accelerations_sum[k] = hn::MulAdd(all(2), a[k], a1[k]);
  }
  stage = stage_at(half, stage.qd, a);
  accelerations(at, stage, a);
  for (int k = 0; k < kCount; ++k) {
    rates[k] = hn::MulAdd(all(2), stage.qd[k], rates[k]);
    accelerations_sum[k] = hn::MulAdd(all(2), a[k], accelerations_sum[k]);
  }
  stage = stage_at(h, stage.qd, a);
  accelerations(at, stage, a);
  for (int k = 0; k < kCount; ++k) {
    to.q[k] = hn::MulAdd(sixth, hn::Add(rates[k], stage.qd[k]), from.q[k]);
    to.qd[k] = hn::MulAdd(sixth, hn::Add(accelerations_sum[k], a[k]), from.qd[k]);
  }
}

}  // namespace HWY_NAMESPACE
}  // namespace walker
}  // namespace walktrack
HWY_AFTER_NAMESPACE();

#endif
