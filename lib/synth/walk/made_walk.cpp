#include "synth/walk/made_walk.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "body/kinematics.h"
#include "body/pose_from_joints.h"
#include "core/conventions.h"
#include "core/errors.h"
#include "synth/walk/foot_path.h"
#include "synth/walk/walk_style.h"

namespace walktrack {
inline namespace synth {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Accelerations of the ankle at both ends of its swing (push-off and braking), in units of its way
// over the square of the swing time. Fitted together with the angles of walk_style.cpp.
constexpr double kPush = 4.5, kBrake = -5;
constexpr double kSway = 0.018;  // m, amplitude of the pelvis' lateral motion (Perry 1992: 4 cm in
                                 // all)
// Per stride; more make no visible difference. By hand.
constexpr int kHarmonics = 8;  // of the pelvis's height
constexpr int kInstants = 96;  // at which legs are evaluated

struct Foot {
  Vector3d ankle;
  double heading, pitch;
};

class Walker {
 public:
  Walker(const Body& body, const MadeWalk& walk)
      : body_(body), walk_(walk), style_(walk_style(body, walk)) {
    step_time_ = style_.step_length / walk.speed;
    find_strike();
    find_heights();
    find_drop();
  }

  JointPositions joints_at(double time) const {
    const double t = time + 2 * step_time_ * walk_.phase;
    Pose pose = pelvis_at(t, height_at(t));
    JointPositions joints = forward_kinematics(body_, pose).joints;
    for (const Side side : {Side::kLeft, Side::kRight}) bend_leg(foot_at(side, t), side, joints);
    const auto bent = pose_from_joints(joints, body_.lengths);
    pose.legs = bent->legs;
    swing_arms(t, pose);
    return forward_kinematics(body_, pose).joints;
  }

 private:
  double path_heading(double distance) const {
    return walk_.heading + walk_.turn_rate / walk_.speed * distance;
  }

  // The point of the path, shifted to the left by `left` metres.
  Vector2d path_point(double distance, double left) const {
    // Distances are counted from the beginning of the phase; the pelvis is at the start at time 0.
    const double passed = walk_.speed * 2 * step_time_ * walk_.phase;
    const double d = distance - passed, bend = walk_.turn_rate / walk_.speed;
    const double a = walk_.heading, b = a + bend * d;
    const Vector2d along = std::abs(bend) < 1e-9 ? Vector2d(d * std::cos(a), d * std::sin(a))
                                                 : Vector2d((std::sin(b) - std::sin(a)) / bend,
                                                            (std::cos(a) - std::cos(b)) / bend);
    return walk_.start + along + left * Vector2d(-std::sin(b), std::cos(b));
  }

  double heading_at(double distance) const {
    return path_heading(distance - walk_.speed * 2 * step_time_ * walk_.phase);
  }

  // The foot on footprint `index` (even = left), `stride` after its strike.
  Foot standing(int index, double stride) const {
    const bool left = index % 2 == 0;
    const double step = style_.step_length;
    const double distance = step * (index + (left ? 0 : walk_.limp)) + strike_ahead_;
    const double pitch = style_.sole_pitch(stride), heading = heading_at(distance);
    const Vector2d flat = path_point(distance, (left ? 0.5 : -0.5) * style_.step_width);
    const Vector2d rolled = rolled_ankle(body_.lengths, pitch);
    const Vector2d ankle = flat + rolled.x() * Vector2d(std::cos(heading), std::sin(heading));
    return {{ankle.x(), ankle.y(), rolled.y()}, heading, pitch};
  }

  Vector2d standing_rate(int index, double stride, double inwards) const {
    const double h = 1e-5 * inwards;
    return (standing(index, stride + h).ankle - standing(index, stride).ankle).head<2>() / h;
  }

  // Number of strides since the first strike of that foot.
  double strides(Side side, double t) const {
    return (t / step_time_ - (side == Side::kLeft ? 0 : 1 + walk_.limp)) / 2;
  }

  Foot foot_at(Side side, double t) const {
    const double cycle = strides(side, t), whole = std::floor(cycle), stride = cycle - whole;
    const int index = 2 * static_cast<int>(whole) + (side == Side::kLeft ? 0 : 1);
    if (stride <= style_.lift) return standing(index, stride);
    const double swing = 1 - style_.lift, share = (stride - style_.lift) / swing;
    const Foot from = standing(index, style_.lift), to = standing(index + 2, 0);
    const Vector2d start = from.ankle.head<2>(), end = to.ankle.head<2>(), way = end - start;
    const Vector2d ankle =
        swing_path({start, swing * standing_rate(index, style_.lift, -1), kPush * way},
                   {end, swing * standing_rate(index + 2, 0, 1), kBrake * way}, share);
    const double pitch = style_.sole_pitch(stride);
    const double turn = to.heading - from.heading;
    return {{ankle.x(), ankle.y(), swinging_ankle(body_.lengths, pitch, share, style_.clearance)},
            from.heading + turn * share * share * (3 - 2 * share),
            pitch};
  }

  // Root, heading, list and tilt; steps begin with strikes, those of the left foot for even ones.
  Pose pelvis_at(double t, double height) const {
    const double steps = t / step_time_;
    const auto stride_wave = [&](double peak) { return std::cos(kPi * (steps - peak)); };
    const double distance = walk_.speed * t;
    const Vector2d ground = path_point(distance, kSway * stride_wave(0.62));
    Pose pose;
    pose.root = {ground.x(), ground.y(), height};
    // Phases and the third harmonic are those of the norms of the Conventional Gait Model: the
    // rotation of the pelvis is largest just after a strike; the pelvis rises on the loaded side
    // and stays up until the next strike.
    pose.heading = heading_at(distance) - style_.rotation * stride_wave(0.09);
    pose.list = style_.list * (stride_wave(0.45) + 0.4 * std::cos(3 * kPi * (steps - 0.29)));
    pose.tilt = style_.lean;
    return pose;
  }

  // The height of the pelvis for which the knee has the flexion of the style.
  double wanted_height(Side side, double t) const {
    const BodyLengths& l = body_.lengths;
    const Vector3d hip_joint = forward_kinematics(body_, pelvis_at(t, 0)).joints[hip(side)];
    const Vector3d ankle_joint = foot_at(side, t).ankle;
    const double bend = style_.knee(strides(side, t));
    const double leg2 =
        l.thigh * l.thigh + l.shank * l.shank + 2 * l.thigh * l.shank * std::cos(bend);
    const double away2 = (hip_joint - ankle_joint).head<2>().squaredNorm();
    return ankle_joint.z() + std::sqrt(std::max(0.0, leg2 - away2)) - hip_joint.z();
  }

  // Share of the body's weight on that leg, which is transferred while both feet are on the ground.
  double bearing(Side side, double t) const {
    constexpr double kNearlyNothing = 1e-6;  // within a jump
    const double cycle = strides(side, t), stride = cycle - std::floor(cycle);
    const double over = style_.lift - 0.5;
    return std::max(kNearlyNothing,
                    smooth_step(stride / over) * smooth_step((style_.lift - stride) / over));
  }

  // Finds the position of a foot in front of the pelvis at its strike for which both legs give the
  // same height of the pelvis.
  void find_strike() {
    double low = 0.2 * style_.step_length, high = 0.8 * style_.step_length;
    for (int i = 0; i < 40; ++i) {
      strike_ahead_ = 0.5 * (low + high);
      const double right = step_time_ * (1 + walk_.limp);
      const double front = wanted_height(Side::kLeft, 0) + wanted_height(Side::kRight, right);
      const double back = wanted_height(Side::kRight, 0) + wanted_height(Side::kLeft, right);
      (front > back ? low : high) = strike_ahead_;
    }
  }

  // Fourier series of the height that the supporting legs give.
  void find_heights() {
    for (int i = 0; i < kInstants; ++i) {
      const double t = 2 * step_time_ * i / kInstants;
      const double left = bearing(Side::kLeft, t), right = bearing(Side::kRight, t);
      const double height =
          (left * wanted_height(Side::kLeft, t) + right * wanted_height(Side::kRight, t)) /
          (left + right);
      height_[0] += height / kInstants;
      for (int k = 1; k <= kHarmonics; ++k) {
        const double angle = 2 * kPi * k * i / kInstants;
        height_[2 * k - 1] += 2 * height * std::cos(angle) / kInstants;
        height_[2 * k] += 2 * height * std::sin(angle) / kInstants;
      }
    }
  }

  double height_at(double t) const {
    double height = height_[0] - drop_;
    for (int k = 1; k <= kHarmonics; ++k) {
      const double angle = kPi * k * t / step_time_;
      height += height_[2 * k - 1] * std::cos(angle) + height_[2 * k] * std::sin(angle);
    }
    return height;
  }

  void swing_arms(double t, Pose& pose) const {
    const double wave = std::cos(kPi * t / step_time_);  // 1 at the left foot's strike
    const double swing = style_.arm_swing;
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const double forward = side == Side::kLeft ? -wave : wave;
      ArmPose& arm = pose.arms[static_cast<size_t>(side)];
      arm = {swing * forward - rad_from_deg(2), rad_from_deg(7),
             rad_from_deg(24) + 0.5 * swing * forward};
    }
  }

  // Computes knee, ankle and toe from the hip and the foot, in the plane of hip, ankle and walking
  // direction.
  void bend_leg(const Foot& foot, Side side, JointPositions& joints) const {
    const BodyLengths& l = body_.lengths;
    const Vector3d& hip_joint = joints[hip(side)];
    const Vector3d leg = foot.ankle - hip_joint;
    const double reach = std::min(leg.norm(), l.thigh + l.shank);
    const Vector3d down = leg.normalized();
    const Vector3d ahead(std::cos(foot.heading), std::sin(foot.heading), 0);
    const Vector3d forward = (ahead - down * down.dot(ahead)).normalized();
    const double cosine =
        (l.thigh * l.thigh + reach * reach - l.shank * l.shank) / (2 * l.thigh * reach);
    const double angle = std::acos(std::clamp(cosine, -1.0, 1.0));
    joints[knee(side)] = hip_joint + l.thigh * (std::cos(angle) * down + std::sin(angle) * forward);
    joints[ankle(side)] = foot.ankle;
    // The foot stays in the plane of the leg: `up` is the direction in that plane at right angles
    // to the direction of walking.
    const Vector3d up = (ahead * ahead.dot(down) - down).normalized();
    const double c = std::cos(foot.pitch), s = std::sin(foot.pitch);
    const double rise = l.ball_height - l.ankle_height;
    joints[toe(side)] =
        foot.ankle + (l.ball_forward * c + rise * s) * ahead + (rise * c - l.ball_forward * s) * up;
  }

  double longest_leg() const {
    double longest = 0;
    for (int i = 0; i < kInstants; ++i) {
      const double t = 2 * step_time_ * i / kInstants;
      const JointPositions joints = forward_kinematics(body_, pelvis_at(t, height_at(t))).joints;
      for (const Side side : {Side::kLeft, Side::kRight})
        longest = std::max(longest, (joints[hip(side)] - foot_at(side, t).ankle).norm());
    }
    return longest;
  }

  // Finds by bisection how much the pelvis has to be lowered so that no leg is straighter than
  // allowed.
  void find_drop() {
    const double leg = body_.lengths.thigh + body_.lengths.shank;
    if (longest_leg() <= walk_.straightest * leg) return;
    double low = 0, high = 0.4 * leg;
    drop_ = high;
    if (longest_leg() > walk_.straightest * leg)
      throw InputError(fmt::format("steps of {:.2f} m are too long for legs of {:.2f} m",
                                   style_.step_length, leg));
    for (int i = 0; i < 40; ++i) {
      drop_ = 0.5 * (low + high);
      (longest_leg() <= walk_.straightest * leg ? high : low) = drop_;
    }
    drop_ = high;
  }

  const Body& body_;
  const MadeWalk& walk_;
  WalkStyle style_;
  double step_time_ = 0, strike_ahead_ = 0, drop_ = 0;
  std::array<double, 2 * kHarmonics + 1> height_{};  // mean, then cosine and sine of each harmonic
};

}  // namespace

Motion made_walk(const Body& body, const MadeWalk& walk) {
  const Walker walker(body, walk);
  Motion motion;
  const int rows = static_cast<int>(std::floor((walk.to - walk.from) * walk.rate + 1e-6)) + 1;
  for (int i = 0; i < rows; ++i) {
    motion.time.push_back(walk.from + i / walk.rate);
    JointPositions joints = walker.joints_at(motion.time.back());
    if (!body.groups.arms) {
      const JointPositions unknown = unknown_joints();
      std::copy(unknown.at.begin() + kJointCountWithoutArms, unknown.at.end(),
                joints.at.begin() + kJointCountWithoutArms);
    }
    motion.joints.push_back(joints);
  }
  return motion;
}

}  // namespace synth
}  // namespace walktrack
