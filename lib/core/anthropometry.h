// Average proportions of an adult, as shares of the stature H, of the body mass M, or of a
// segment's length, for the walkers, the drawn body and the forces.
//
// Sources: lengths, Drillis & Contini 1966, in Winter, "Biomechanics and Motor Control of Human
// Movement", 4th ed. 2009, fig. 4.1; masses, centres of mass (from the proximal end) and radii of
// gyration (about the centre of mass), Dempster 1955, in Winter, table 4.1.
#pragma once

namespace walktrack {
inline namespace core {
namespace anthropometry {

// Lengths, shares of H; kAnkleHeight is the height above the sole.
inline constexpr double kThigh = .245, kShank = .246, kAnkleHeight = .039, kTrunk = .288;

struct SegmentShares {
  double mass;      // of M
  double centre;    // of the length, from the proximal end
  double gyration;  // of the length, about the centre
};
// Head, arms and trunk together, from the hips up; the trunk's length is that to the shoulders.
inline constexpr SegmentShares kHeadArmsTrunk{.678, .626, .496};
inline constexpr SegmentShares kThighShares{.100, .433, .323};
inline constexpr SegmentShares kShankShares{.0465, .433, .302};
inline constexpr SegmentShares kFootShares{.0145, .5, .475};
inline constexpr SegmentShares kShankAndFoot{.061, .606, .416};
inline constexpr SegmentShares kUpperArmShares{.028, .436, .322};
inline constexpr SegmentShares kForearmAndHand{.022, .682, .468};
inline constexpr SegmentShares kWholeArm{.050, .530, .368};

// m/s, used if nothing else is known. By hand; adults choose 1.2 to 1.5 (Bohannon 1997, Age and
// Ageing 26, 15-19).
inline constexpr double kUsualSpeed = 1.25;

// Knee flexion at which the heel touches the thigh, degrees. By hand; passive limits are 140 to 155
// (Roach & Miles 1991, Physical Therapy 71, 656-665). Walking stays below 70.
inline constexpr double kDeepestKneeBendDeg = 150;

}  // namespace anthropometry
}  // namespace core
}  // namespace walktrack
