#include "io/figure/animated_figure.h"

#include <algorithm>

#include "body/axes.h"
#include "body/pose_from_joints.h"
#include "io/tables/motion_file.h"

namespace walktrack {
inline namespace io {

namespace {

using Eigen::Matrix3d;
using Eigen::Quaterniond;
using Eigen::Vector3d;

constexpr double kNoDirection = 1e-6;     // m; two points nearer than this define no direction
constexpr double kNearlyParallel = 1e-3;  // a reference direction that is too nearly parallel to be
                                          // used

enum Node : size_t { kPelvisNode, kTrunkNode, kNeckNode };

// How a node's offset in the rest pose is defined.
enum class Rest {
  kFixed,  // a position in the parent's axes
  kUp,     // along the parent's bone
  kDown,
  kToe,
};

struct Plan {
  FigureNode node;
  Rest rest;
  Vector3d usual;  // offset if the motion does not determine it, m
};

Vector3d toe_of(const BodyLengths& l) {
  return {l.ball_forward, 0, l.ball_height - l.ankle_height};
}

void plan_leg(std::vector<Plan>& out, Side side, const BodyLengths& l) {
  const bool left = side == Side::kLeft;
  const int first = static_cast<int>(out.size());
  const double half = 0.5 * outward(side) * l.hip_width;
  out.push_back({{left ? "lhip" : "rhip", 0, hip(side), true}, Rest::kFixed, {0, half, 0}});
  out.push_back(
      {{left ? "lknee" : "rknee", first, knee(side), true}, Rest::kDown, {0, 0, -l.thigh}});
  out.push_back(
      {{left ? "lankle" : "rankle", first + 1, ankle(side), true}, Rest::kDown, {0, 0, -l.shank}});
  out.push_back({{left ? "ltoe" : "rtoe", first + 2, toe(side), false}, Rest::kToe, toe_of(l)});
}

void plan_arm(std::vector<Plan>& out, Side side, const BodyLengths& l) {
  const bool left = side == Side::kLeft;
  const int first = static_cast<int>(out.size());
  const double half = 0.5 * outward(side) * l.shoulder_width;
  out.push_back({{left ? "lshoulder" : "rshoulder", kTrunkNode,
                  left ? Joint::kLeftShoulder : Joint::kRightShoulder, true},
                 Rest::kFixed,
                 {0, half, l.trunk}});
  out.push_back(
      {{left ? "lelbow" : "relbow", first, left ? Joint::kLeftElbow : Joint::kRightElbow, true},
       Rest::kDown,
       {0, 0, -l.upper_arm}});
  out.push_back({{left ? "lwrist" : "rwrist", first + 1,
                  left ? Joint::kLeftWrist : Joint::kRightWrist, false},
                 Rest::kDown,
                 {0, 0, -l.forearm}});
}

std::vector<Plan> plan_of(bool arms, const BodyLengths& l) {
  std::vector<Plan> out{
      {{"pelvis", -1, Joint::kPelvis, true}, Rest::kFixed, {0, 0, 0}},
      {{"trunk", kPelvisNode, std::nullopt, true}, Rest::kFixed, {0, 0, 0}},
      {{"neck", kTrunkNode, Joint::kNeck, true}, Rest::kUp, {0, 0, l.neck}},
      {{"head", kNeckNode, Joint::kHead, false}, Rest::kUp, {0, 0, l.head - l.neck}}};
  for (const Side side : {Side::kLeft, Side::kRight}) plan_leg(out, side, l);
  for (const Side side : {Side::kLeft, Side::kRight})
    if (arms) plan_arm(out, side, l);
  return out;
}

bool points_somewhere(const Vector3d& direction) {
  return known(direction) && direction.norm() > kNoDirection;
}

// Axes with z along `up` and y as near to `left` as possible; y is arbitrary if they are parallel.
Matrix3d axes_along(const Vector3d& up, const Vector3d& left) {
  const Vector3d along = up.normalized();
  const bool says = known(left) && along.cross(left.normalized()).norm() > kNearlyParallel;
  return axes_with_z(along, says ? left : along.unitOrthogonal());
}

// Axes with y along `left` and z as near to `up` as possible.
Matrix3d axes_across(const Vector3d& left, const Vector3d& up) {
  const Vector3d across = left.normalized();
  const bool says = across.cross(up.normalized()).norm() > kNearlyParallel;
  const Vector3d other = says ? up : across.unitOrthogonal();
  Matrix3d out;
  out.col(1) = across;
  out.col(2) = (other - across * across.dot(other)).normalized();
  out.col(0) = out.col(1).cross(out.col(2));
  return out;
}

// Computes the world axes of every node in one frame.
class FrameAxes {
 public:
  FrameAxes(const JointPositions& joints, const BodyLengths& lengths, bool arms)
      : joints_(joints), foot_(axes_with_x(toe_of(lengths), Vector3d::UnitY())) {
    root = 0.5 * (joints[Joint::kLeftHip] + joints[Joint::kRightHip]);
    const Joint top = known(joints[Joint::kNeck]) ? Joint::kNeck : Joint::kHead;
    const Vector3d spine = joints[top] - root;
    const bool upright = points_somewhere(spine);
    const Vector3d hips = joints[Joint::kLeftHip] - joints[Joint::kRightHip];
    const Matrix3d pelvis = axes_across(hips, upright ? spine : Vector3d::UnitZ().eval());
    axes.push_back(pelvis);
    const Vector3d shoulders = joints[Joint::kLeftShoulder] - joints[Joint::kRightShoulder];
    const bool across = arms && points_somewhere(shoulders);
    const Matrix3d trunk = upright ? axes_along(spine, across ? shoulders : hips) : pelvis;
    axes.push_back(trunk);
    const Vector3d neck = joints[Joint::kHead] - joints[Joint::kNeck];
    axes.push_back(points_somewhere(neck) ? axes_along(neck, trunk.col(1)) : trunk);
    axes.push_back(axes.back());
    for (const Side side : {Side::kLeft, Side::kRight}) add_leg(side, pelvis.col(1));
    for (const Side side : {Side::kLeft, Side::kRight})
      if (arms) add_arm(side, trunk);
  }

  Vector3d root;
  std::vector<Matrix3d> axes;  // world_from_node

 private:
  void add_leg(Side side, const Vector3d& left) {
    const Vector3d hinge = leg_hinge_axis(joints_, side, left);
    const Vector3d sideways = known(hinge) ? hinge : left;
    axes.push_back(axes_along(joints_[hip(side)] - joints_[knee(side)], sideways));
    const Matrix3d shank = axes_along(joints_[knee(side)] - joints_[ankle(side)], sideways);
    axes.push_back(shank);
    const Vector3d foot = joints_[toe(side)] - joints_[ankle(side)];
    const bool turned =
        points_somewhere(foot) && foot.normalized().cross(sideways).norm() > kNearlyParallel;
    axes.push_back(turned ? (axes_with_x(foot, sideways) * foot_.transpose()).eval() : shank);
    axes.push_back(axes.back());
  }

  // The elbow's hinge axis is weighted by the sine of its flexion, and the trunk's left axis
  // slightly.
  void add_arm(Side side, const Matrix3d& trunk) {
    const bool left = side == Side::kLeft;
    const Vector3d& shoulder = joints_[left ? Joint::kLeftShoulder : Joint::kRightShoulder];
    const Vector3d& elbow = joints_[left ? Joint::kLeftElbow : Joint::kRightElbow];
    const Vector3d& wrist = joints_[left ? Joint::kLeftWrist : Joint::kRightWrist];
    const Vector3d upper = shoulder - elbow, fore = elbow - wrist;
    Vector3d hinge = trunk.col(1);
    if (points_somewhere(upper) && points_somewhere(fore))
      hinge = fore.normalized().cross(upper.normalized()) + 0.3 * trunk.col(1);
    axes.push_back(points_somewhere(upper) ? axes_along(upper, hinge) : trunk);
    axes.push_back(points_somewhere(fore) ? axes_along(fore, hinge) : axes.back());
    axes.push_back(axes.back());
  }

  const JointPositions& joints_;
  Matrix3d foot_;  // direction of the toe at rest
};

bool legs_are_known(const JointPositions& joints) {
  for (const Side side : {Side::kLeft, Side::kRight}) {
    if (!points_somewhere(joints[hip(side)] - joints[knee(side)])) return false;
    if (!points_somewhere(joints[knee(side)] - joints[ankle(side)])) return false;
  }
  return points_somewhere(joints[Joint::kLeftHip] - joints[Joint::kRightHip]);
}

// Offsets are kept; a joint that is unknown is NaN.
FigureFrame frame_of(const JointPositions& joints, const FrameAxes& seen,
                     const std::vector<Plan>& plan) {
  FigureFrame out{seen.root, {}, {}};
  std::vector<Vector3d> places;
  for (size_t i = 0; i < plan.size(); ++i) {
    const FigureNode& node = plan[i].node;
    const bool at_root = !node.joint || node.parent < 0;
    places.push_back(at_root ? seen.root : joints[*node.joint]);
    const Matrix3d parent =
        node.parent < 0 ? Matrix3d::Identity().eval() : seen.axes[static_cast<size_t>(node.parent)];
    out.turn.emplace_back(Quaterniond(parent.transpose() * seen.axes[i]).normalized());
    const Vector3d from = node.parent < 0 ? seen.root : places[static_cast<size_t>(node.parent)];
    out.offset.push_back(parent.transpose() * (places.back() - from));
  }
  return out;
}

Vector3d rest_offset(const Plan& plan, const Vector3d& mean, double mean_length) {
  switch (plan.rest) {
    case Rest::kFixed:
      return mean;
    case Rest::kUp:
      return {0, 0, mean_length};
    case Rest::kDown:
      return {0, 0, -mean_length};
    case Rest::kToe:
      break;
  }
  return mean_length * plan.usual.normalized();
}

void set_rest_pose(const std::vector<Plan>& plan, AnimatedFigure& figure) {
  for (size_t i = 0; i < plan.size(); ++i) {
    Vector3d sum = Vector3d::Zero();
    double length = 0, count = 0;
    for (const auto& frame : figure.frames) {
      if (!frame || !known(frame->offset[i])) continue;
      sum += frame->offset[i];
      length += frame->offset[i].norm();
      ++count;
    }
    figure.nodes[i].offset =
        count > 0 ? rest_offset(plan[i], sum / count, length / count) : plan[i].usual;
    for (auto& frame : figure.frames)
      if (frame && !known(frame->offset[i])) frame->offset[i] = figure.nodes[i].offset;
  }
}

}  // namespace

bool AnimatedFigure::any_frame() const {
  return std::any_of(frames.begin(), frames.end(), [](const auto& frame) { return !!frame; });
}

AnimatedFigure animated_figure(const Motion& motion, const BodyLengths& lengths) {
  const bool arms = listed_joint_count(motion) == kJointCount;
  const std::vector<Plan> plan = plan_of(arms, lengths);
  AnimatedFigure out;
  for (const Plan& each : plan) out.nodes.push_back(each.node);
  out.time = motion.time;
  for (const JointPositions& joints : motion.joints) {
    out.frames.emplace_back();
    if (legs_are_known(joints))
      out.frames.back() = frame_of(joints, FrameAxes(joints, lengths, arms), plan);
  }
  set_rest_pose(plan, out);
  return out;
}

std::vector<Vector3d> rest_places(const AnimatedFigure& figure, double ankle_height) {
  std::vector<Vector3d> out;
  double lowest = 0;
  for (const FigureNode& node : figure.nodes) {
    const Vector3d parent =
        node.parent < 0 ? Vector3d::Zero().eval() : out[static_cast<size_t>(node.parent)];
    out.push_back(parent + node.offset);
    if (node.joint == Joint::kLeftAnkle || node.joint == Joint::kRightAnkle)
      lowest = std::min(lowest, out.back().z());
  }
  for (Vector3d& place : out) place.z() += ankle_height - lowest;
  return out;
}

}  // namespace io
}  // namespace walktrack
