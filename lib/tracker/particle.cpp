#include "tracker/particle.h"

#include <algorithm>
#include <cmath>

#include "body/kinematics.h"

namespace walktrack {

namespace {

size_t index(Side side) { return static_cast<size_t>(side); }

// Knees do not bend backwards: the leg's shank follows its thigh.
void keep_knees(KneedState& s) {
  s.q[kStanceShank] = std::max(s.q[kStanceShank], s.q[kStanceThigh]);
  s.q[kSwingShank] = std::max(s.q[kSwingShank], s.q[kSwingThigh]);
}

// A normal number made heavy-tailed: people mostly walk straight on, but when they turn, they turn.
double heavy_tailed(double normal) { return std::sinh(normal); }

void set_leg(const KneedState& s, bool stance, const Extras& extra, Side side, Pose& pose) {
  const double thigh = s.q[stance ? kStanceThigh : kSwingThigh];
  const double shank = s.q[stance ? kStanceShank : kSwingShank];
  const size_t i = index(side);
  pose.legs[i] = {s.q[kTorso] - thigh, extra[kAbduction + i], extra[kRotation + i], shank - thigh,
                  extra[kAnkle + i]};
}

}  // namespace

KneedState shown_state(const KneedState& walker, Side stance, const Extras& extra) {
  const size_t standing = index(stance), swinging = 1 - standing;
  KneedState shown = walker;
  shown.q[kTorso] += extra[kTilt];
  shown.q[kStanceThigh] += extra[kThigh + standing];
  shown.q[kStanceShank] += extra[kShank + standing];
  shown.q[kSwingThigh] += extra[kThigh + swinging];
  shown.q[kSwingShank] += extra[kShank + swinging];
  keep_knees(shown);
  return shown;
}

Pose pose_of(const BodyModel& model, const KneedState& walker, Side stance,
             const Eigen::Vector2d& ball, const Extras& extra) {
  const KneedState shown = shown_state(walker, stance, extra);
  Pose pose;
  pose.heading = extra[kHeading];
  pose.list = extra[kList];
  pose.tilt = shown.q[kTorso];
  set_leg(shown, true, extra, stance, pose);
  set_leg(shown, false, extra, other(stance), pose);
  for (size_t i = 0; model.body.groups.arms && i < 2; ++i)
    pose.arms[i] = {extra[kShoulder + i], extra[kShoulderAbduction + i], extra[kElbow + i]};
  const double ankle_height = kneed_posture(model.walker, shown).stance_ankle.y();
  const double pitch = sole_pitch(model.body.lengths, ankle_height);
  stand_on(model.body, stance, Eigen::Vector3d(ball.x(), ball.y(), 0), pitch, pose);
  return pose;
}

void realise(const BodyModel& model, const NoiseScale& scale, WalkerParticle& particle) {
  const auto& z = particle.noise;
  Vector5 impulse;
  for (int k = 0; k < 5; ++k) impulse[k] = scale.impulse[size_t(k)] * z[size_t(kTorqueNoise + k)];
  // A torque held through the frame moves the angle half as far as its final rate would.
  const Vector5 kick = particle.velocity_per_impulse * impulse;
  KneedState& walker = particle.walker;
  walker = particle.predicted;
  walker.qd += kick;
  walker.q += 0.5 * scale.elapsed * kick;
  keep_knees(walker);
  for (int k = 0; k < extra_count(model.body); ++k) {
    const size_t i = size_t(k);
    const double noise = z[size_t(kExtraNoise) + i];
    particle.extra[i] = particle.predicted_extra[i] +
                        scale.extra[i] * (i == kHeading ? heavy_tailed(noise) : noise);
  }
  if (particle.arriving) particle.extra_before = particle.extra;
  const double heading = particle.extra[kHeading];
  const Eigen::Vector2d ahead(std::cos(heading), std::sin(heading));
  particle.ball =
      particle.predicted_ball +
      particle.ball_sigma *
          (z[kBallNoise] * ahead + z[kBallNoise + 1] * Eigen::Vector2d(-ahead.y(), ahead.x()));
  particle.pose = pose_of(model, walker, particle.stance, particle.ball, particle.extra);
}

Eigen::Vector2d landing_ball(const Body& body, const Pose& pose, Side swing) {
  const Eigen::Vector3d ankle = pose.root + ankle_from_root(body, pose, swing);
  const double outward = swing == Side::kLeft ? 1 : -1;
  const double toes = pose.heading - outward * pose.legs[index(swing)].hip_rotation;
  return ankle.head<2>() +
         body.lengths.ball_forward * Eigen::Vector2d(std::cos(toes), std::sin(toes));
}

KneedModel in_plane(const BodyModel& model, double heading) {
  KneedModel out = model.walker;
  out.gravity.x() = model.downhill.dot(Eigen::Vector2d(std::cos(heading), std::sin(heading)));
  return out;
}

}  // namespace walktrack
