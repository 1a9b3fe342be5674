// A motion as a tree of rotating joints, as files of animated figures store it (BVH, glTF).
//
// The tree has the joints of joints.csv, and a trunk that rotates against the pelvis at the
// pelvis's position:
//   pelvis -> trunk -> neck -> head;  pelvis -> lhip -> lknee -> lankle -> ltoe, and right;
//   with arms  trunk -> lshoulder -> lelbow -> lwrist, and right
// In the rest pose the figure stands upright and faces along x, every joint's axes are those of the
// world (x forward, y left, z up), and offsets are means over the motion. A frame's `offset`
// contains the difference between a length and its mean, so that joint positions are those of the
// motion.
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
  std::optional<Joint> joint;       // at its position; the trunk has none
  bool turns;                       // false for ends: head, toes, wrists
  Eigen::Vector3d offset{0, 0, 0};  // from the parent in the rest pose, m
};

struct FigureFrame {
  Eigen::Vector3d root;  // position of the pelvis, world, m
  // By node: parent_from_node, and the position in the parent's axes, m; those of the rest pose if
  // a joint is not known.
  std::vector<Eigen::Quaterniond> turn;
  std::vector<Eigen::Vector3d> offset;
};

struct AnimatedFigure {
  std::vector<FigureNode> nodes;  // the pelvis first
  std::vector<double> time;       // s
  // nullopt if a hip, knee or ankle is unknown, or if the two ends of a bone coincide.
  std::vector<std::optional<FigureFrame>> frames;

  bool any_frame() const;
};

// `lengths` replace those of joints that are never known. The figure has arms if one of their
// joints is ever known.
AnimatedFigure animated_figure(const Motion& motion, const BodyLengths& lengths);

// Positions of the nodes in the rest pose, with the feet on the ground and the pelvis above the
// origin, m.
std::vector<Eigen::Vector3d> rest_places(const AnimatedFigure& figure, double ankle_height);

}  // namespace io
}  // namespace walktrack
