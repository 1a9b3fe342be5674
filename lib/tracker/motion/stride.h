// The difference between people's legs and the kneed walker's over a stride: the walker keeps its
// stance knee against a stop, transfers its weight at once and extends the swinging leg early;
// people flex the knee when a foot takes the load, flex the trailing knee before the toes leave the
// ground, and extend it late.
//
// The difference is that between a measured walk (subject 4 of the OpenCap validation, Uhlrich et
// al., PLOS Comput. Biol. 19(10), 2023, trial walking1, 1.30 m/s, joint centres from motion
// capture, strikes from force plates, both legs) and the prior's gait of the same speed, windowed
// so that it is zero when a foot strikes, because the legs change roles then and feet must not
// jump. For the stance leg only the flexion of the knee is kept, with the hip over the ankle, which
// keeps the foot still.
#pragma once

namespace walktrack {
inline namespace tracker {

// Added to the angles of the walker's thigh and shank (walker/kneed/kneed_walker.h), rad.
struct LegDifference {
  double thigh, shank;
};

// At a phase of the leg's own stride: 0 when its foot strikes, 1/2 when the other does. Periodic.
LegDifference leg_difference(double phase);

}  // namespace tracker
}  // namespace walktrack
