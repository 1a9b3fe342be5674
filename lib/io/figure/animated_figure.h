// A motion as a tree of joints that turn, as files of animated figures hold it (BVH, glTF).
//
// The tree has the joints of joints.csv, and a trunk that turns against the pelvis at the pelvis's
// own place:
//   pelvis -> trunk -> neck -> head;  pelvis -> lhip -> lknee -> lankle -> ltoe, and right;
//   with arms  trunk -> lshoulder -> lelbow -> lwrist, and right
// In the rest pose the figure stands upright and looks along x, every joint's axes are those of the
// world (x forward, y left, z up), and offsets are means over the motion. Joint places are those of
// the motion but for what a length differs from its mean: `offset` of a frame keeps that.
#pragma once

#include <array>
#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Geometry>

#include "body/motion.h"
#include "body/subject.h"

namespace walktrack {
inline namespace io {

struct FigureNode {
  std::string_view name;
  int parent;                       // its index, smaller than the node's own; -1: none
  std::optional<Joint> joint;       // whose place it has; the trunk has none
  bool turns;                       // ends do not: head, toes, wrists
  Eigen::Vector3d offset{0, 0, 0};  // from the parent in the rest pose, m
};

struct FigureFrame {
  Eigen::Vector3d root;  // place of the pelvis, world, m
  // By node: parent_from_node, and the place in the parent's axes, m; the rest pose's where a joint
  // is not known.
  std::vector<Eigen::Quaterniond> turn;
  std::vector<Eigen::Vector3d> offset;
};

struct AnimatedFigure {
  std::vector<FigureNode> nodes;  // the pelvis first
  std::vector<double> time;       // s
  // nullopt where a hip, knee or ankle is unknown, or two that a bone joins coincide.
  std::vector<std::optional<FigureFrame>> frames;

  bool any_frame() const;
};

// `lengths` stand in for joints that are never known. Arms are there if one of their joints ever
// is.
AnimatedFigure animated_figure(const Motion& motion, const BodyLengths& lengths);

// Where a node is in the rest pose, feet on the ground, the pelvis above the origin, m.
std::vector<Eigen::Vector3d> rest_places(const AnimatedFigure& figure, double ankle_height);

}  // namespace io
}  // namespace walktrack
