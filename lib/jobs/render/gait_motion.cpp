#include "jobs/render/gait_motion.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "body/kinematics.h"
#include "core/conventions.h"
#include "core/errors.h"
#include "jobs/prior/prior_walk.h"
#include "tracker/motion/models/planar_body.h"
#include "tracker/state/particle.h"

namespace walktrack {
inline namespace jobs {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kRowRate = 240;    // Hz, sample rate of the motion: as high as that of the fastest
                                    // cameras
constexpr int kMarginRows = 60;     // before time 0 and after the end, for shutters and for events
constexpr double kArmPerLeg = 0.6;  // relative to the swing of the opposite thigh; Murray et al.
                                    // 1967
constexpr double kArmAside = 0.1, kElbow = 0.35;  // rad
constexpr double kNoStep = std::numeric_limits<double>::quiet_NaN();

size_t index(Side side) { return static_cast<size_t>(side); }

KneedState kneed_state(const WalkerState& state) {
  KneedState out;
  out.q = state.q;
  out.qd = state.qd;
  out.contact_x = state.contacts.front();
  return out;
}

// Simulates the walker of a job and records the ground reaction.
class Walking {
 public:
  Walking(const SimulateJob& job, double start)
      : job_(job), walker_(make_walker(job.model)), state_(first_state()) {
    state_.time = start;
    note(state_);
  }

  void go_to(double time) {
    while (state_.time < time) {
      const auto observe = [this](const WalkerState& now) { note(now); };
      const bool stepped = advance(*walker_, state_, time - state_.time, {}, events_, observe);
      if (state_.health != Health::kSound)
        throw InputError(fmt::format("gait: the walker falls at {:.2f} s", state_.time));
      if (stepped) change_support();
    }
  }

  const WalkerState& state() const { return state_; }
  Side stance() const { return stance_; }
  std::vector<GroundRecord> take_records() { return std::move(records_); }

 private:
  WalkerState first_state() const {
    const Eigen::VectorXd x = start_point(job_.model, *walker_);
    const Eigen::Index n = x.size() / 2;
    return walker_->section_state(x.head(n), x.tail(n));
  }

  // A jump of momentum at one time is an impulse on the supporting foot.
  void note(const WalkerState& now) {
    const PlanarMomentum momentum = walker_->momentum(now);
    const ContactForce contact = walker_->contact_forces(now).front();
    const WalkerEnergy energy = walker_->energy(now);
    GroundRecord record{now.time,       stance_,        momentum.com,  contact.point,
                        last_impulses_, energy.kinetic, energy.gravity};
    Vector2d& impulse = record.impulse[index(stance_)];
    if (!records_.empty()) {
      const double dt = now.time - records_.back().time;
      impulse += dt > 0 ? Vector2d(0.5 * dt * (last_force_ + contact.force))
                        : Vector2d(momentum.linear - last_momentum_);
    }
    last_impulses_ = record.impulse;
    last_force_ = contact.force;
    last_momentum_ = momentum.linear;
    records_.push_back(record);
  }

  // The heel strike has been recorded as one jump at the supporting foot; a part of it belongs to
  // the landing foot.
  void change_support() {
    GroundRecord& strike = records_.back();
    const Vector2d landing = events_.back().transition.impulse;
    strike.impulse[index(stance_)] -= landing;
    stance_ = other(stance_);
    strike.impulse[index(stance_)] += landing;
    strike.stance = stance_;
    last_impulses_ = strike.impulse;
    walker_ = job_.next_walker(state_);
    state_ = walker_->settled(state_);
    note(state_);
  }

  const SimulateJob& job_;
  std::unique_ptr<Walker> walker_;
  WalkerState state_;
  Side stance_ = Side::kLeft;
  std::vector<WalkerEvent> events_;
  std::vector<GroundRecord> records_;
  std::array<Vector2d, 2> last_impulses_{Vector2d::Zero(), Vector2d::Zero()};
  Vector2d last_force_, last_momentum_;
};

// The pose with heading 0 above the ground of the plane of walking.
Pose pose_in_plane(const BodyModel& model, const WalkerState& walker, Side stance) {
  const KneedState state = kneed_state(walker);
  const Vector2d hips = kneed_posture(model.walker, state).hip;
  Pose pose;
  pose.root = {hips.x(), 0, hips.y()};
  pose.tilt = state.q[kTorso];
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const double thigh = state.q[side == stance ? kStanceThigh : kSwingThigh];
    const double shank = state.q[side == stance ? kStanceShank : kSwingShank];
    LegPose& leg = pose.legs[index(side)];
    leg.hip_flexion = pose.tilt - thigh;
    leg.knee_flexion = shank - thigh;
    leg.ankle_dorsiflexion = shank - sole_pitch(model.body.lengths, rolled_ankle(model, shank));
    pose.arms[index(other(side))] = {kArmPerLeg * leg.hip_flexion, kArmAside, kElbow};
  }
  return pose;
}

// The first record after a time.
std::vector<GroundRecord>::const_iterator first_after(const std::vector<GroundRecord>& records,
                                                      double time) {
  return std::upper_bound(records.begin(), records.end(), time,
                          [](double t, const GroundRecord& record) { return t < record.time; });
}

// The last record before a time; steps of the simulation are a millisecond.
const GroundRecord& record_at(const std::vector<GroundRecord>& records, double time) {
  const auto after = first_after(records, time);
  return after == records.begin() ? records.front() : *std::prev(after);
}

// Impulses up to a time, interpolated between the neighbouring records; at an event, those after
// it.
std::array<Vector2d, 2> impulses_at(const std::vector<GroundRecord>& records, double time) {
  const auto after = first_after(records, time);
  const GroundRecord& a = record_at(records, time);
  if (after == records.begin() || after == records.end()) return a.impulse;
  const double share = (time - a.time) / (after->time - a.time);
  return {(1 - share) * a.impulse[0] + share * after->impulse[0],
          (1 - share) * a.impulse[1] + share * after->impulse[1]};
}

KineticsFrame frame_at(const WalkedGait& walked, double time, double interval) {
  const GroundRecord& now = record_at(walked.ground, time);
  const auto before = impulses_at(walked.ground, time - 0.5 * interval);
  const auto after = impulses_at(walked.ground, time + 0.5 * interval);
  const auto in_world = [&](const Vector2d& point, double aside) -> Vector3d {
    return walked.world_from_plane * Vector3d(point.x(), aside, point.y());
  };
  KineticsFrame frame;
  frame.known = true;
  frame.com = in_world(now.com, 0);
  frame.kinetic_energy = now.kinetic;
  frame.potential_energy = now.potential;
  frame.legs.fill({kNoStep, kNoStep, kNoStep, kNoStep, kNoStep, kNoStep, kNoStep});
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const size_t i = index(side);
    const Vector2d force = (after[i] - before[i]) / interval;
    const double aside = side == Side::kLeft ? walked.foot_aside : -walked.foot_aside;
    frame.feet[i].force = walked.world_from_plane.linear() * Vector3d(force.x(), 0, force.y());
    if (side == now.stance) frame.feet[i].centre = in_world(now.contact, aside).head<2>();
    frame.ground.force += frame.feet[i].force;
  }
  return frame;
}

}  // namespace

WalkedGait walked_gait(const GaitWalk& walk, const Subject& subject, double slope,
                       double duration) {
  BodyModel model{make_body(subject, {.head = true, .arms = true}), {}, Vector2d::Zero()};
  SimulateJob job;
  job.model = default_model("kneed");
  job.model.kneed = kneed_parameters(subject, kStandardGravity);
  job.model.kneed.slope = slope;
  model.walker = kneed_model(job.model.kneed);
  job = with_prior(std::move(job), walk.plan);
  WalkedGait out;
  out.foot_aside = 0.5 * model.body.lengths.hip_width;
  const int rows = static_cast<int>(std::ceil(duration * kRowRate)) + kMarginRows;
  Walking walking(job, -kMarginRows / kRowRate);
  Vector3d origin = Vector3d::Zero();
  for (int row = -kMarginRows; row <= rows; ++row) {
    out.motion.time.push_back(row / kRowRate);
    walking.go_to(out.motion.time.back());
    const Pose pose = pose_in_plane(model, walking.state(), walking.stance());
    if (row == 0) origin.x() = pose.root.x();
    out.motion.joints.push_back(forward_kinematics(model.body, pose).joints);
  }
  out.ground = walking.take_records();
  out.world_from_plane = Eigen::Translation3d(walk.start.x(), walk.start.y(), 0) *
                         Eigen::AngleAxisd(walk.heading, Vector3d::UnitZ()) *
                         Eigen::Translation3d(-origin);
  for (JointPositions& joints : out.motion.joints)
    for (Vector3d& joint : joints.at) joint = out.world_from_plane * joint;
  return out;
}

Kinetics ground_kinetics(const WalkedGait& walked, std::span<const double> times, double interval) {
  Kinetics out;
  for (const double time : times) {
    out.time.push_back(time);
    out.frames.push_back(frame_at(walked, time, interval));
  }
  return out;
}

}  // namespace jobs
}  // namespace walktrack
