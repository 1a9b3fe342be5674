#include "synth/made_walk.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "body/kinematics.h"
#include "body/pose_from_joints.h"
#include "core/conventions.h"
#include "core/errors.h"

namespace walktrack {
inline namespace synth {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kStance = 0.62;       // share of the stride
constexpr double kStrikeAhead = 0.52;  // of a step: ankle ahead of the pelvis when the heel strikes
constexpr double kHeelBack = 0.23;     // of the foot's length behind the ankle (body/subject.cpp)
constexpr double kClearance = 0.035;   // m, of the sole in mid-swing
constexpr double kUsualStep = 0.7;     // m; movements of the pelvis scale with the step

// The sole's pitch (degrees, heel up positive) over the stride from strike to strike.
struct Key {
  double at, pitch_deg;
};
constexpr std::array<Key, 9> kPitch{{{0, -18},
                                     {.09, 0},
                                     {.36, 0},
                                     {.50, 18},
                                     {.62, 56},
                                     {.74, 28},
                                     {.86, -6},
                                     {.95, -19},
                                     {1, -18}}};

// Slope at a key that keeps the curve monotone between keys (Fritsch & Butland 1984).
double key_slope(size_t i) {
  const size_t last = kPitch.size() - 1;
  const auto rise = [](size_t k) {
    return (kPitch[k + 1].pitch_deg - kPitch[k].pitch_deg) / (kPitch[k + 1].at - kPitch[k].at);
  };
  const double before = i == 0 ? rise(last - 1) : rise(i - 1);
  const double after = i == last ? rise(0) : rise(i);
  return before * after <= 0 ? 0 : 2 * before * after / (before + after);
}

double sole_pitch_at(double stride, double step_length) {
  size_t i = 0;
  while (i + 2 < kPitch.size() && stride > kPitch[i + 1].at) ++i;
  const double span = kPitch[i + 1].at - kPitch[i].at, s = (stride - kPitch[i].at) / span;
  const double s2 = s * s, s3 = s2 * s;
  const double pitch_deg =
      (2 * s3 - 3 * s2 + 1) * kPitch[i].pitch_deg + (s3 - 2 * s2 + s) * span * key_slope(i) +
      (3 * s2 - 2 * s3) * kPitch[i + 1].pitch_deg + (s3 - s2) * span * key_slope(i + 1);
  return rad_from_deg(pitch_deg) * std::min(1.2, step_length / kUsualStep);
}

// The quintic from p0 to p1 with end velocities v0, v1 and no acceleration at the ends.
Vector2d quintic(const Vector2d& p0, const Vector2d& v0, const Vector2d& p1, const Vector2d& v1,
                 double s) {
  const double s3 = s * s * s, s4 = s3 * s, s5 = s4 * s;
  return p0 * (1 - 10 * s3 + 15 * s4 - 6 * s5) + v0 * (s - 6 * s3 + 8 * s4 - 3 * s5) +
         p1 * (10 * s3 - 15 * s4 + 6 * s5) + v1 * (-4 * s3 + 7 * s4 - 3 * s5);
}

struct Foot {
  Vector3d ankle;
  double heading, pitch;
};

class Walker {
 public:
  Walker(const Body& body, const MadeWalk& walk) : body_(body), walk_(walk) {
    const double preferred = 0.40 * body.subject.height * std::pow(walk.speed / 1.25, 0.42);
    step_ = walk.step_length.value_or(preferred);
    step_time_ = step_ / walk.speed;
    heel_back_ = kHeelBack * body.lengths.foot;
    find_height();
  }

  JointPositions joints_at(double time) const {
    const double t = time + 2 * step_time_ * walk_.phase;
    Pose pose = pelvis_at(t, height_);
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

  // The path `left` metres beside itself.
  Vector2d path_point(double distance, double left) const {
    // Distances count from where the phase began; the start is where the pelvis is at time 0.
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

  // Foot of footprint `index` (even = left) on the ground, `stride` after its strike.
  Foot standing(int index, double stride) const {
    const BodyLengths& l = body_.lengths;
    const double distance = step_ * (index + (index % 2 == 0 ? 0 : walk_.limp) + kStrikeAhead);
    const double pitch = sole_pitch_at(stride, step_), c = std::cos(pitch), s = std::sin(pitch);
    // Turning about the heel's or the ball's place on the ground.
    const double ahead = pitch < 0 ? heel_back_ * (c - 1) + l.ankle_height * s
                                   : l.ball_forward * (1 - c) + l.ankle_height * s;
    const double up = l.ankle_height * c + (pitch < 0 ? -heel_back_ : l.ball_forward) * s;
    const double heading = heading_at(distance), side = index % 2 == 0 ? 0.5 : -0.5;
    const Vector2d flat = path_point(distance, side * walk_.step_width);
    const Vector2d ankle = flat + ahead * Vector2d(std::cos(heading), std::sin(heading));
    return {{ankle.x(), ankle.y(), up}, heading, pitch};
  }

  Vector2d standing_rate(int index, double stride, double inwards) const {
    const double h = 1e-5 * inwards;
    return (standing(index, stride + h).ankle - standing(index, stride).ankle).head<2>() / h;
  }

  Foot foot_at(Side side, double t) const {
    const double lag = side == Side::kLeft ? 0 : 1 + walk_.limp;
    const double cycle = (t / step_time_ - lag) / 2;
    const double whole = std::floor(cycle), stride = cycle - whole;
    const int index = 2 * static_cast<int>(whole) + (side == Side::kLeft ? 0 : 1);
    if (stride <= kStance) return standing(index, stride);
    const double share = (stride - kStance) / (1 - kStance);
    const Foot from = standing(index, kStance), to = standing(index + 2, 0);
    const Vector2d ankle =
        quintic(from.ankle.head<2>(), (1 - kStance) * standing_rate(index, kStance, -1),
                to.ankle.head<2>(), (1 - kStance) * standing_rate(index + 2, 0, 1), share);
    // The sole's lowest point rises smoothly and comes down again.
    const double lift = 16 * kClearance * share * share * (1 - share) * (1 - share);
    const Foot rolled = standing(index, stride);
    const double turn = to.heading - from.heading;
    return {{ankle.x(), ankle.y(), rolled.ankle.z() + lift},
            from.heading + turn * share * share * (3 - 2 * share),
            rolled.pitch};
  }

  // Root, heading, list and tilt; steps begin with strikes, of the left foot for even ones.
  Pose pelvis_at(double t, double height) const {
    const double scale = step_ / kUsualStep, steps = t / step_time_;
    const auto stride_wave = [&](double peak) { return std::cos(kPi * (steps - peak)); };
    const double distance = walk_.speed * t;
    const Vector2d ground = path_point(distance, 0.018 * stride_wave(0.62));
    Pose pose;
    // Lowest in the middle of double support.
    const double lowest = 0.5 * (2 * kStance - 1) * 2;
    const double bob = -0.02 * scale * scale * std::cos(2 * kPi * (steps - 0.5 * lowest));
    pose.root = {ground.x(), ground.y(), height + bob};
    pose.heading = heading_at(distance) - rad_from_deg(5) * scale * stride_wave(0);
    pose.list = rad_from_deg(3.5) * scale * stride_wave(0.35);
    pose.tilt = walk_.lean;
    return pose;
  }

  void swing_arms(double t, Pose& pose) const {
    const double wave = std::cos(kPi * t / step_time_);  // 1 at the left foot's strike
    const double swing = rad_from_deg(20) * walk_.arm_swing * std::min(1.5, walk_.speed / 1.25);
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const double forward = side == Side::kLeft ? -wave : wave;
      ArmPose& arm = pose.arms[static_cast<size_t>(side)];
      arm = {swing * forward - rad_from_deg(2), rad_from_deg(7),
             rad_from_deg(24) + 0.5 * swing * forward};
    }
  }

  // Knee, ankle and toe from the hip and the foot, in the plane of hip, ankle and walking
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
    // The foot stays in the leg's plane: `up` is that plane's direction square to the way.
    const Vector3d up = (ahead * ahead.dot(down) - down).normalized();
    const double c = std::cos(foot.pitch), s = std::sin(foot.pitch);
    const double rise = l.ball_height - l.ankle_height;
    joints[toe(side)] =
        foot.ankle + (l.ball_forward * c + rise * s) * ahead + (rise * c - l.ball_forward * s) * up;
  }

  double longest_leg(double height) const {
    constexpr int kInstants = 80;
    double longest = 0;
    for (int i = 0; i < kInstants; ++i) {
      const double t = 2 * step_time_ * i / kInstants;
      const JointPositions joints = forward_kinematics(body_, pelvis_at(t, height)).joints;
      for (const Side side : {Side::kLeft, Side::kRight})
        longest = std::max(longest, (joints[hip(side)] - foot_at(side, t).ankle).norm());
    }
    return longest;
  }

  // The highest pelvis at which no leg is straighter than it may be, by bisection.
  void find_height() {
    const double leg = body_.lengths.thigh + body_.lengths.shank;
    double low = 0.6 * leg, high = 1.1 * leg;
    if (longest_leg(low) > walk_.straightest * leg)
      throw InputError(
          fmt::format("steps of {:.2f} m are too long for legs of {:.2f} m", step_, leg));
    for (int i = 0; i < 40; ++i) {
      const double middle = 0.5 * (low + high);
      (longest_leg(middle) <= walk_.straightest * leg ? low : high) = middle;
    }
    height_ = low;
  }

  const Body& body_;
  const MadeWalk& walk_;
  double step_, step_time_, heel_back_, height_ = 0;
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
