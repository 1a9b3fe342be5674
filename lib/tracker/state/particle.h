// A particle is one hypothesis: a kneed walker in its vertical plane, the place and direction of
// that plane, and the angles that the walker does not drive. Only here a planar state becomes a 3-D
// pose.
//
// The state of a frame is the state that physics predicts plus standardised normal noise, which
// `apply_noise` adds. Because the noise is kept separately, the filter's moves can explore it
// reversibly (preconditioned Crank-Nicolson: z' = sqrt(1 - s^2) z + s n leaves N(0, 1) invariant;
// Cotter, Roberts, Stuart & White, Stat. Sci. 28, 2013), without simulating again.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include <Eigen/Core>

#include "body/body.h"
#include "body/pose.h"
#include "core/rng.h"
#include "tracker/state/residual_table.h"
#include "walker/kneed/kneed_walker.h"

namespace walktrack {
inline namespace tracker {

// The paths of walkers:
//   spatial   anywhere over the ground, with turns
//   sagittal  straight ahead: everything moves in upright planes of one heading, which is found at
//             the start, and only the places of feet may be off to the side; this is what one
//             camera sees of a walk from the side
enum class Path { kSpatial, kSagittal };

// The regime of a particle (tracker/motion/standing.h).
enum class Regime : uint8_t { kWalking, kStanding };

// How a walker came from the frame before: by its own motion; by a jump to another moment of a step
// (tracker/moves/phase_jump.h) or between the regimes; or because it was caught (Outcome).
enum class Continuation : uint8_t { kSimulated, kJumped, kCaught };

// The coordinates on which the noise of a frame acts.
enum NoiseIndex {
  kTorqueNoise,                   // 5: torso, hip, stance knee, swing knee, stance ankle
  kBallNoise = kTorqueNoise + 5,  // 2: the place of the stance foot, along and across
  kResidualNoise = kBallNoise + 2,
  kNoiseCount = kResidualNoise + kResidualCount
};

// Standard deviations of one frame's noise, derived from MotionConfig and the frame's length.
struct NoiseScale {
  std::array<double, 5> impulse{};  // N m s
  double elapsed = 0;               // s, the frame's length
  ResidualAngles residual{};        // rad
};

// The speed and step length at which the present step aims; chosen anew at every support transfer.
struct StepAim {
  double speed = 0;        // m/s
  double step_length = 0;  // m

  double duration() const { return step_length / speed; }  // s
};

struct WalkerParticle {
  // The predicted state, before this frame's noise.
  KneedState predicted;
  // rad/s per N m s of each torque noise
  Eigen::Matrix<double, 5, 5> velocity_per_impulse = Eigen::Matrix<double, 5, 5>::Zero();
  Eigen::Vector2d predicted_ball = Eigen::Vector2d::Zero();
  // Standard deviations of the stance foot's place in this frame, along and across the heading, m.
  Eigen::Vector2d ball_sigma = Eigen::Vector2d::Zero();
  ResidualAngles predicted_residual{};
  std::array<double, kNoiseCount> noise{};  // standard normal

  // The state with this frame's noise.
  KneedState walker;
  Side stance = Side::kLeft;
  Eigen::Vector2d ball = Eigen::Vector2d::Zero();  // of the stance foot, on the ground, m
  ResidualAngles residual{}, residual_before{};    // now and one frame ago
  Pose pose, pose_before;                          // now and one frame ago
  // Mean velocity of the root over about the last step, forward and to the left, m/s.
  Eigen::Vector2d way = Eigen::Vector2d::Zero();
  // Whether this is the first frame: there is no frame before, and residual angles start at rest.
  bool first_frame = false;
  Regime regime = Regime::kWalking;
  Continuation continuation = Continuation::kSimulated;  // into this frame

  KneedControls controls;
  StepAim aim;
};

// Everything that all particles of a scene share.
struct BodyModel {
  Body body;
  KneedModel walker;  // in axes across the slope, if there is one: its gravity points straight down
  Eigen::Vector2d downhill = Eigen::Vector2d::Zero();  // horizontal gravity, m/s^2; 0 on the level
  Path path = Path::kSpatial;
};

// Whether a coordinate has a process on a path, with or without arms. A coordinate without a
// process keeps the value that it has at the start, and is neither predicted nor drawn.
constexpr bool is_free(const ResidualRow& row, Path path, bool arms) {
  return (path == Path::kSpatial || !row.sideways) && (arms || row.moves != Moves::kArm);
}

// The coordinates that have a process in this model.
inline const ResidualList& free_residuals(const BodyModel& model) {
  static constexpr auto kFree = [](Path path, bool arms) {
    return residuals_where([=](const ResidualRow& row) { return is_free(row, path, arms); });
  };
  static constexpr ResidualList kSpatial = kFree(Path::kSpatial, false),
                                kSpatialArms = kFree(Path::kSpatial, true),
                                kSagittal = kFree(Path::kSagittal, false),
                                kSagittalArms = kFree(Path::kSagittal, true);
  const bool arms = model.body.groups.arms;
  if (model.path == Path::kSpatial) return arms ? kSpatialArms : kSpatial;
  return arms ? kSagittalArms : kSagittal;
}

// Whether walkers may turn.
inline bool turns(const BodyModel& model) { return model.path == Path::kSpatial; }

// Sets the state with noise (walker, ball, residual, pose) from the predicted state and the noise:
// the first function for a kneed walker, the second for any walker, without the pose.
void apply_noise(const BodyModel& model, const NoiseScale& scale, WalkerParticle& particle);
void realise_walker(const BodyModel& model, const NoiseScale& scale, WalkerParticle& particle);

// The walker's state with a person's leg angles (tracker/motion/stride.h) and the residual angles
// added.
KneedState shown_state(const KneedState& walker, Side stance, const StepAim& aim,
                       const ResidualAngles& residual);

// The angles of both arms.
std::array<ArmPose, 2> arms_of(const ResidualAngles& residual);

// The pose of a walker whose stance foot has its ball at `ball`.
Pose pose_of(const BodyModel& model, const KneedState& walker, Side stance, const StepAim& aim,
             const Eigen::Vector2d& ball, const ResidualAngles& residual);

// The same for a walker whose state with a person's angles is `shown` and whose own stance shank
// leans by `shank`, rad.
Pose pose_showing(const BodyModel& model, const KneedState& shown, double shank, Side stance,
                  const Eigen::Vector2d& ball, const ResidualAngles& residual);

// The stance ankle relative to the place of its ball, (forward, up), m, when the walker's round
// foot has rolled so far that its shank leans by `shank`, rad. At 0 the foot is flat, with its ball
// BodyLengths::ball_forward ahead of the ankle; the hip moves as smoothly as the walker's.
Eigen::Vector2d rolled_ankle(const BodyModel& model, double shank);

// The place of the ball of the `landed` foot: from it the ankle, with the shank leaning by `shank`,
// has rolled to its place in `pose`.
Eigen::Vector2d landing_ball(const BodyModel& model, const Pose& pose, Side landed, double shank);

// Horizontal gravity along `heading`, m/s^2.
double gravity_along(const BodyModel& model, double heading);

// The walker in the plane of `heading`, with the slope and the gravity in that plane.
KneedModel in_plane(const BodyModel& model, double heading);

// The walker on a slope, rad, positive downhill, whatever the heading.
KneedModel on_slope(const BodyModel& model, double slope);

// Directions on a slope for which tables of gaits are kept, evenly spaced from the steepest climb
// to the steepest descent. On level ground there is only one.
std::vector<double> table_headings(const Eigen::Vector2d& downhill);
// The direction whose slope is about that of `heading`.
size_t table_heading(const Eigen::Vector2d& downhill, double heading);

}  // namespace tracker
}  // namespace walktrack
