// One hypothesis: a kneed walker in its vertical plane, where that plane stands, and the angles
// that the walker does not drive. The one place where a planar state becomes a 3-D pose.
//
// A frame's state is what physics predicted plus standardised normal noise brought in by
// `apply_noise`. Keeping the noise apart lets the filter's moves explore it reversibly
// (preconditioned Crank-Nicolson: z' = sqrt(1 - s^2) z + s n leaves N(0, 1) invariant; Cotter,
// Roberts, Stuart & White, Stat. Sci. 28, 2013), without simulating again.
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

// Where walkers may go and what shows of them:
//   spatial   anywhere over the ground, turning
//   sagittal  straight on: everything moves in upright planes of one heading, found at the start,
//             and only where feet come to stand may be off to the side; what one camera sees of a
//             walk from the side
enum class Path { kSpatial, kSagittal };

// What a particle does (tracker/motion/standing.h).
enum class Regime : uint8_t { kWalking, kStanding };

// Where the noise of a frame acts.
enum NoiseIndex {
  kTorqueNoise,                   // 5: torso, hip, stance knee, swing knee, stance ankle
  kBallNoise = kTorqueNoise + 5,  // 2: the standing foot's place, along and across
  kResidualNoise = kBallNoise + 2,
  kNoiseCount = kResidualNoise + kResidualCount
};

// Standard deviations of one frame's noise, derived from MotionConfig and the frame's length.
struct NoiseScale {
  std::array<double, 5> impulse{};  // N m s
  double elapsed = 0;               // s, the frame's length
  ResidualAngles residual{};        // rad
};

// What the present step aims at; chosen anew at every support transfer.
struct StepAim {
  double speed = 0;        // m/s
  double step_length = 0;  // m

  double duration() const { return step_length / speed; }  // s
};

struct WalkerParticle {
  // As predicted, before this frame's noise.
  KneedState predicted;
  // rad/s per N m s of each torque noise
  Eigen::Matrix<double, 5, 5> velocity_per_impulse = Eigen::Matrix<double, 5, 5>::Zero();
  Eigen::Vector2d predicted_ball = Eigen::Vector2d::Zero();
  // Of the standing foot's place in this frame, along and across the heading, m.
  Eigen::Vector2d ball_sigma = Eigen::Vector2d::Zero();
  ResidualAngles predicted_residual{};
  std::array<double, kNoiseCount> noise{};  // standard normal

  // As realised.
  KneedState walker;
  Side stance = Side::kLeft;
  Eigen::Vector2d ball = Eigen::Vector2d::Zero();  // of the standing foot, on the ground, m
  ResidualAngles residual{}, residual_before{};    // now and one frame ago
  Pose pose, pose_before;                          // now and one frame ago
  // How the root has moved in about the last step, forward and to the left, m/s.
  Eigen::Vector2d way = Eigen::Vector2d::Zero();
  bool arriving =
      false;  // the first frame: there is no frame before, residual angles start at rest
  Regime regime = Regime::kWalking;

  KneedControls controls;
  StepAim aim;
};

// What all particles of a scene share.
struct BodyModel {
  Body body;
  KneedModel walker;  // across the slope, where there is one: its gravity points straight down
  Eigen::Vector2d downhill = Eigen::Vector2d::Zero();  // horizontal gravity, m/s^2; 0 on the level
  Path path = Path::kSpatial;
};

// Whether a coordinate has a process on a path, with arms or without them. One that has none keeps
// the value that it was given at the start, and is neither predicted nor drawn.
constexpr bool is_free(const ResidualRow& row, Path path, bool arms) {
  return (path == Path::kSpatial || !row.sideways) && (arms || row.moves != Moves::kArm);
}

// Those that have one in this model.
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

// Sets the realised part (walker, ball, residual, pose) from the predicted part and the noise: of a
// kneed walker, and of any walker but for the pose.
void apply_noise(const BodyModel& model, const NoiseScale& scale, WalkerParticle& particle);
void realise_walker(const BodyModel& model, const NoiseScale& scale, WalkerParticle& particle);

// The walker's state as the person shows it: with a person's legs (tracker/motion/stride.h),
// strayed by the residual angles.
KneedState shown_state(const KneedState& walker, Side stance, const StepAim& aim,
                       const ResidualAngles& residual);

// Both arms' angles.
std::array<ArmPose, 2> arms_of(const ResidualAngles& residual);

// The pose of a walker whose standing foot has its ball at `ball`.
Pose pose_of(const BodyModel& model, const KneedState& walker, Side stance, const StepAim& aim,
             const Eigen::Vector2d& ball, const ResidualAngles& residual);

// The same of a walker whose state as the person shows it is `shown` and whose own standing shank
// leans by `shank`, rad.
Pose pose_showing(const BodyModel& model, const KneedState& shown, double shank, Side stance,
                  const Eigen::Vector2d& ball, const ResidualAngles& residual);

// The standing ankle relative to its ball's place, (forward, up), m, when the walker's round foot
// has rolled to where its shank leans by `shank`, rad. The foot is flat at 0, its ball
// BodyLengths::ball_forward ahead of the ankle; the hip goes on as smoothly as the walker's.
Eigen::Vector2d rolled_ankle(const BodyModel& model, double shank);

// Where the ball of the `landed` foot comes to stand: the place from which its ankle, with the
// shank leaning by `shank`, has rolled to where it is in `pose`.
Eigen::Vector2d landing_ball(const BodyModel& model, const Pose& pose, Side landed, double shank);

// Horizontal gravity along `heading`, m/s^2.
double gravity_along(const BodyModel& model, double heading);

// The walker in the plane of `heading`: the slope and the gravity that it meets there.
KneedModel in_plane(const BodyModel& model, double heading);

// The walker on a slope, rad, positive downhill, whatever the heading.
KneedModel on_slope(const BodyModel& model, double slope);

// Directions on a slope for which tables of gaits are kept: evenly from the steepest climb to the
// steepest descent. On the level one stands for all.
std::vector<double> table_headings(const Eigen::Vector2d& downhill);
// Which of them meets about the slope that `heading` meets.
size_t table_heading(const Eigen::Vector2d& downhill, double heading);

}  // namespace tracker
}  // namespace walktrack
