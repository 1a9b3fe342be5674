// The members of all structs in checkpoints and frame files (io/archive/archive.h), with the values
// that are allowed.
#pragma once

#include <limits>

#include "io/archive/archive.h"
#include "observation/observer.h"
#include "tracker/tracker.h"

namespace walktrack {
inline namespace io {

constexpr Side last_value(Side) { return Side::kRight; }
constexpr Regime last_value(Regime) { return Regime::kStanding; }
constexpr Continuation last_value(Continuation) { return Continuation::kCaught; }

// A count of events.
template <typename T>
Within<T> a_count(T& value) {
  return within(value, 0, std::numeric_limits<std::remove_const_t<T>>::max());
}

// A sum of weights, which rounding may increase slightly beyond 1.
template <typename T>
Within<T> a_share(T& value) {
  constexpr double kRounding = 1e-9;
  return within(value, -kRounding, 1 + kRounding);
}

template <typename Archive, ArchivedAs<LegPose> T>
void fields(Archive& archive, T& value) {
  auto& [hip_flexion, hip_abduction, hip_rotation, knee_flexion, ankle_dorsiflexion] = value;
  archive(hip_flexion, hip_abduction, hip_rotation, knee_flexion, ankle_dorsiflexion);
}

template <typename Archive, ArchivedAs<ArmPose> T>
void fields(Archive& archive, T& value) {
  auto& [shoulder_flexion, shoulder_abduction, elbow_flexion] = value;
  archive(shoulder_flexion, shoulder_abduction, elbow_flexion);
}

template <typename Archive, ArchivedAs<Pose> T>
void fields(Archive& archive, T& value) {
  auto& [root, heading, list, tilt, legs, arms] = value;
  archive(root, heading, list, tilt, legs, arms);
}

template <typename Archive, ArchivedAs<JointPositions> T>
void fields(Archive& archive, T& value) {
  auto& [at] = value;
  archive(any_number(at));
}

template <typename Archive, ArchivedAs<KneedState> T>
void fields(Archive& archive, T& value) {
  auto& [q, qd, stance_stop, swing_stop, contact_x, since_transfer, clearance, transfers, hasty] =
      value;
  archive(q, qd, stance_stop, swing_stop, contact_x, since_transfer, clearance, a_count(transfers),
          a_count(hasty));
}

template <typename Archive, ArchivedAs<SpringDamper> T>
void fields(Archive& archive, T& value) {
  auto& [stiffness, damping, rest] = value;
  archive(stiffness, damping, rest);
}

template <typename Archive, ArchivedAs<KneedControls> T>
void fields(Archive& archive, T& value) {
  auto& [torso, hip, stance_knee, swing_knee, toe_off_impulse] = value;
  archive(torso, hip, stance_knee, swing_knee, toe_off_impulse);
}

template <typename Archive, ArchivedAs<StepAim> T>
void fields(Archive& archive, T& value) {
  auto& [speed, step_length] = value;
  archive(speed, step_length);
}

template <typename Archive, ArchivedAs<WalkerParticle> T>
void fields(Archive& archive, T& value) {
  auto& [predicted, velocity_per_impulse, predicted_ball, ball_sigma, predicted_residual, noise,
         walker, stance, ball, residual, residual_before, pose, pose_before, way, first_frame,
         regime, continuation, controls, aim] = value;
  archive(predicted, velocity_per_impulse, predicted_ball, ball_sigma, predicted_residual, noise,
          walker, stance, ball, residual, residual_before, pose, pose_before, way, first_frame,
          regime, continuation, controls, aim);
}

template <typename Archive, ArchivedAs<ParticleSet<WalkerParticle>> T>
void fields(Archive& archive, T& value) {
  auto& [states, log_weights, log_likelihoods] = value;
  // Dead particles have the weight -infinity; their state is arbitrary.
  archive(any_number(states), any_number(log_weights), any_number(log_likelihoods));
}

template <typename Archive, ArchivedAs<FilterState<WalkerParticle>> T>
void fields(Archive& archive, T& value) {
  auto& [set, scale] = value;
  archive(set, a_share(scale));
}

template <typename Archive, ArchivedAs<LastSeen> T>
void fields(Archive& archive, T& value) {
  auto& [position, velocity, frame] = value;
  archive(position, velocity, frame);
}

template <typename Archive, ArchivedAs<Stature> T>
void fields(Archive& archive, T& value) {
  auto& [height, sd] = value;
  archive(within(height, 0.1, 10), within(sd, 0, 10));
}

template <typename Archive, ArchivedAs<MonitorState> T>
void fields(Archive& archive, T& value) {
  auto& [last_seen, log_likelihoods, below, outscored, off, fits] = value;
  archive(last_seen, log_likelihoods, a_count(below), a_count(outscored), a_count(off), fits);
}

template <typename Archive, ArchivedAs<MovingPerson> T>
void fields(Archive& archive, T& value) {
  auto& [mean, covariance] = value;
  archive(mean, covariance);
}

template <typename Archive, ArchivedAs<OtherPerson> T>
void fields(Archive& archive, T& value) {
  auto& [place, seen, unseen] = value;
  archive(place, a_count(seen), a_count(unseen));
}

template <typename Archive, ArchivedAs<NearbyPeople> T>
void fields(Archive& archive, T& value) {
  auto& [subject, usual_score, frames, others] = value;
  archive(subject, usual_score, a_count(frames), others);
}

template <typename Archive, ArchivedAs<SubjectEstimates> T>
void fields(Archive& archive, T& value) {
  auto& [stature, girth, trunk] = value;
  archive(stature, girth, trunk);
}

template <typename Archive, ArchivedAs<TrackerState> T>
void fields(Archive& archive, T& value) {
  auto& [frame, starts, filter, monitor, losses, p_legs_swapped, speed, estimates, keypoints_lead,
         people, frames_beside_others] = value;
  archive(frame, starts, filter, monitor, a_count(losses), a_share(p_legs_swapped), speed,
          estimates, keypoints_lead, people, a_count(frames_beside_others));
}

template <typename Archive, ArchivedAs<BackgroundModel> T>
void fields(Archive& archive, T& value) {
  auto& [width, height, change, from_video, luma, orange, green, luma_precision, chroma_precision] =
      value;
  archive(a_count(width), a_count(height), change.levels.black, change.levels.gain,
          change.colourless, a_share(from_video), luma, orange, green, luma_precision,
          chroma_precision);
}

template <typename Archive, ArchivedAs<AppearanceState> T>
void fields(Archive& archive, T& value) {
  auto& [frames, anchor, recent, anchor_pixels, log_density] = value;
  archive(a_count(frames), anchor, recent, anchor_pixels, log_density);
}

template <typename Archive, ArchivedAs<PixelRect> T>
void fields(Archive& archive, T& value) {
  auto& [x0, y0, x1, y1] = value;
  archive(x0, y0, x1, y1);
}

template <typename Archive, ArchivedAs<Region> T>
void fields(Archive& archive, T& value) {
  auto& [area, metres_per_px, picture, points, subject] = value;
  archive(area, metres_per_px, picture, points, subject);
}

template <typename Archive, ArchivedAs<GreyImage> T>
void fields(Archive& archive, T& value) {
  auto& [width, height, pixels] = value;
  archive(a_count(width), a_count(height), pixels);
}

template <typename Archive, ArchivedAs<SilhouetteTerm::State> T>
void fields(Archive& archive, T& value) {
  auto& [background, appearance, scene, frames] = value;
  archive(background, appearance, scene, a_count(frames));
}

template <typename Archive, ArchivedAs<FlowTerm::State> T>
void fields(Archive& archive, T& value) {
  auto& [grey_before] = value;
  archive(grey_before);
}

// By likelihood term. A term whose state is not empty has fields() here or in its own header.
template <typename Archive, ArchivedAs<ObserverState> T>
void fields(Archive& archive, T& value) {
  Terms::each([&]<typename Term>() {
    using State =
        std::conditional_t<std::is_const_v<T>, const typename Term::State, typename Term::State>;
    if constexpr (!std::is_empty_v<typename Term::State>) archive(static_cast<State&>(value));
  });
}

template <typename Archive, ArchivedAs<Spread> T>
void fields(Archive& archive, T& value) {
  auto& [mean, sd, p05, p95] = value;
  archive(mean, sd, p05, p95);
}

template <typename Archive, ArchivedAs<FrameEstimate> T>
void fields(Archive& archive, T& value) {
  auto& [joint_count, joints, spread, pose, angles, left_stance, since_transfer, speed] = value;
  archive(within(joint_count, 0, size_t{kJointCount}), joints, spread, pose, angles,
          a_share(left_stance), since_transfer, speed);
}

template <typename Archive, ArchivedAs<FilterReport> T>
void fields(Archive& archive, T& value) {
  auto& [log_evidence, ess, layers, dead, accepted, all_dead] = value;
  archive(any_number(log_evidence), ess, a_count(layers), a_count(dead), accepted, all_dead);
}

template <typename Archive, ArchivedAs<StrideModes> T>
void fields(Archive& archive, T& value) {
  auto& [phase, p_legs_swapped, standing] = value;
  archive(phase, p_legs_swapped, a_share(standing));
}

template <typename Archive, ArchivedAs<HistoryShares> T>
void fields(Archive& archive, T& value) {
  auto& [jumped, caught] = value;
  archive(a_share(jumped), a_share(caught));
}

template <typename Archive, ArchivedAs<FigureFit> T>
void fields(Archive& archive, T& value) {
  auto& [overlap, seen, better_beside] = value;
  archive(any_number(overlap), seen, better_beside);
}

template <typename Archive, ArchivedAs<KeypointEvidence::Point> T>
void fields(Archive& archive, T& value) {
  auto& [px, precision, at_best] = value;
  archive(px, precision, at_best);
}

template <typename Archive, ArchivedAs<KeypointEvidence> T>
void fields(Archive& archive, T& value) {
  auto& [people, offsets] = value;
  archive(people, offsets);
}

template <typename Archive, ArchivedAs<ImageInformation> T>
void fields(Archive& archive, T& value) {
  auto& [walker, pose, information] = value;
  archive(walker, pose, information);
}

template <typename Archive, ArchivedAs<FrameRecord> T>
void fields(Archive& archive, T& value) {
  auto& [tracked, estimate, images, filter, mean_log_likelihood, samples, fallen, diverged, history,
         modes, names, evidence, keypoints, fit, moving, out_of_picture] = value;
  archive(tracked, estimate, images, filter, any_number(mean_log_likelihood), samples,
          a_count(fallen), a_count(diverged), history, modes, names, any_number(evidence),
          keypoints, fit, moving, out_of_picture);
}

}  // namespace io
}  // namespace walktrack
