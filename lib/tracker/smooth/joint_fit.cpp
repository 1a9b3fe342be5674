#include "tracker/smooth/joint_fit.h"

#include <initializer_list>
#include <utility>
#include <vector>

#include "body/kinematics.h"
#include "body/pose_from_joints.h"
#include "core/dense.h"
#include "core/median.h"

namespace walktrack {
inline namespace tracker {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;

constexpr int kFitSteps = 6;
constexpr double kFitDifference = 1e-5;
constexpr Index kAxes = 3;

struct Target {
  Joint joint;
  Vector3d at;
  double sd;
};

// The point in the direction of `end` from `from`, as far away as the body has it.
std::optional<Target> end_target(const JointPositions& measured, const JointPositions& own,
                                 Joint from, Joint end, double sd) {
  const Vector3d way = measured[end] - measured[from];
  if (!known(measured[end]) || way.isZero()) return std::nullopt;
  const double length = (own[end] - own[from]).norm();
  return Target{end, measured[from] + length * way.normalized(), sd};
}

std::vector<Target> targets_of(const JointPositions& measured, const JointPositions& own,
                               double sd) {
  std::vector<Target> out;
  const auto add_end = [&](Joint from, Joint end) {
    if (const auto target = end_target(measured, own, from, end, kEndSpread * sd))
      out.push_back(*target);
  };
  for (const Side side : {Side::kLeft, Side::kRight}) {
    for (const Joint joint : {hip(side), knee(side), ankle(side)})
      out.push_back({joint, measured[joint], sd});
    add_end(ankle(side), toe(side));
  }
  if (known(measured[Joint::kPelvis])) add_end(Joint::kPelvis, Joint::kNeck);
  return out;
}

VectorXd points(const BodyModel& model, const std::vector<Target>& targets, const Pose& pose) {
  const JointPositions joints = forward_kinematics(model.body, pose).joints;
  VectorXd out(kAxes * static_cast<Index>(targets.size()));
  for (size_t i = 0; i < targets.size(); ++i)
    out.segment<kAxes>(kAxes * static_cast<Index>(i)) = joints[targets[i].joint];
  return out;
}

MatrixXd slopes(const BodyModel& model, const FreeNumbers& free, const std::vector<Target>& targets,
                const Pose& pose) {
  const VectorXd values = values_of(free, pose);
  MatrixXd out(kAxes * static_cast<Index>(targets.size()), values.size());
  for (Index k = 0; k < values.size(); ++k) {
    const VectorXd aside = kFitDifference * VectorXd::Unit(values.size(), k);
    out.col(k) = (points(model, targets, with_values(free, pose, values + aside)) -
                  points(model, targets, with_values(free, pose, values - aside))) /
                 (2 * kFitDifference);
  }
  return out;
}

using Points = std::pair<Vector3d, Vector3d>;

// The median distance between two points of a row that are known, for each of the functions that
// name such points; nullopt if they never are.
std::optional<double> median_distance(const Motion& motion,
                                      std::initializer_list<Points (*)(const JointPositions&)> of) {
  std::vector<double> lengths;
  for (const JointPositions& joints : motion.joints) {
    for (const auto points : of) {
      const auto [from, to] = points(joints);
      if (known(from) && known(to)) lengths.push_back((to - from).norm());
    }
  }
  return lengths.empty() ? std::nullopt : std::optional(median_of(std::move(lengths)));
}

template <Joint kFrom, Joint kTo>
Points bone(const JointPositions& joints) {
  return {joints[kFrom], joints[kTo]};
}

// From the hips' axis to the height of the shoulders.
Points trunk(const JointPositions& joints) {
  return {joints[Joint::kPelvis],
          0.5 * (joints[Joint::kLeftShoulder] + joints[Joint::kRightShoulder])};
}

}  // namespace

std::optional<JointFit> fit_joints(const BodyModel& model, const JointPositions& measured,
                                   double sd) {
  const std::optional<Pose> first = pose_from_joints(measured, model.body.lengths);
  if (!first) return std::nullopt;
  const FreeNumbers free = free_numbers(model);
  const std::vector<Target> targets =
      targets_of(measured, forward_kinematics(model.body, *first).joints, sd);
  VectorXd wanted(kAxes * static_cast<Index>(targets.size())), weights(wanted.size());
  for (size_t i = 0; i < targets.size(); ++i) {
    wanted.segment<kAxes>(kAxes * static_cast<Index>(i)) = targets[i].at;
    weights.segment<kAxes>(kAxes * static_cast<Index>(i))
        .setConstant(1 / (targets[i].sd * targets[i].sd));
  }
  const VectorXd prior = spreads_of(free).cwiseInverse().cwiseAbs2();
  JointFit out{*first, {}};
  for (int step = 0; step < kFitSteps; ++step) {
    const MatrixXd slope = slopes(model, free, targets, out.pose);
    out.information = slope.transpose() * weights.asDiagonal() * slope;
    const VectorXd pull =
        slope.transpose() * weights.cwiseProduct(wanted - points(model, targets, out.pose)) -
        prior.cwiseProduct(difference(free, *first, out.pose));
    const MatrixXd whole = out.information + MatrixXd(prior.asDiagonal());
    out.pose = with_values(free, out.pose, values_of(free, out.pose) + solve_positive(whole, pull));
  }
  return out;
}

Subject with_lengths_of(const Motion& motion, Subject subject) {
  using enum Joint;
  SubjectLengths& lengths = subject.lengths;
  const auto set = [&](std::optional<double>& length,
                       std::initializer_list<Points (*)(const JointPositions&)> of) {
    if (!length) length = median_distance(motion, of);
  };
  set(lengths.thigh, {bone<kLeftHip, kLeftKnee>, bone<kRightHip, kRightKnee>});
  set(lengths.shank, {bone<kLeftKnee, kLeftAnkle>, bone<kRightKnee, kRightAnkle>});
  set(lengths.hip_width, {bone<kLeftHip, kRightHip>});
  set(lengths.trunk, {trunk});
  set(lengths.shoulder_width, {bone<kLeftShoulder, kRightShoulder>});
  set(lengths.upper_arm, {bone<kLeftShoulder, kLeftElbow>, bone<kRightShoulder, kRightElbow>});
  set(lengths.forearm, {bone<kLeftElbow, kLeftWrist>, bone<kRightElbow, kRightWrist>});
  return subject;
}

}  // namespace tracker
}  // namespace walktrack
