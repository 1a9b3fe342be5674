#include "body/subject.h"

#include "core/anthropometry.h"

namespace walktrack {
inline namespace body {

namespace {

using namespace anthropometry;

// Further shares of the stature; see the header for the sources. The ball is at 72 % of the foot's
// length from the heel and the ankle at 23 % (Winter fig. 4.1 and table 4.1); C7 is .040 H above
// the shoulders' height .818 H, the head's centre is midway between chin .870 H and vertex (Drillis
// & Contini). Hip centres: Seidel et al., J. Biomech. 28 (1995), 14 % of the pelvic width inside
// the anterior iliac spines, about .100 H apart.
constexpr double kFoot = .152;
constexpr double kBallForward = .49, kBallHeight = .0125;
constexpr double kHipWidth = .100, kNeckAboveTrunk = .040, kHeadAboveTrunk = .117;
constexpr double kShoulderWidth = .205, kUpperArm = .186, kForearm = .146;

}  // namespace

BodyLengths body_lengths(const Subject& subject) {
  const double h = subject.height;
  const SubjectLengths& given = subject.lengths;
  BodyLengths out{};
  out.thigh = given.thigh.value_or(kThigh * h);
  out.shank = given.shank.value_or(kShank * h);
  out.ankle_height = given.ankle_height.value_or(kAnkleHeight * h);
  out.foot = given.foot.value_or(kFoot * h);
  out.ball_forward = kBallForward * out.foot;
  out.ball_height = kBallHeight * h;
  out.hip_width = given.hip_width.value_or(kHipWidth * h);
  out.trunk = given.trunk.value_or(kTrunk * h);
  out.neck = out.trunk + kNeckAboveTrunk * h;
  out.head = out.trunk + kHeadAboveTrunk * h;
  out.shoulder_width = given.shoulder_width.value_or(kShoulderWidth * h);
  out.upper_arm = given.upper_arm.value_or(kUpperArm * h);
  out.forearm = given.forearm.value_or(kForearm * h);
  return out;
}

double leg_length(const BodyLengths& lengths) {
  return lengths.thigh + lengths.shank + lengths.ankle_height;
}

}  // namespace body
}  // namespace walktrack
