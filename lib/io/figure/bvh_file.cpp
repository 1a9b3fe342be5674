#include "io/figure/bvh_file.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "body/axes.h"
#include "body/joint_angles.h"
#include "core/conventions.h"
#include "io/tables/csv.h"

namespace walktrack {
inline namespace io {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr double kLocked = 1 - 1e-12;    // sine of the middle angle beyond which the other two are
                                         // not separable
constexpr double kShortest = 1e-6;       // m
constexpr double kHyperextended = 0.01;  // m; a knee this far behind the line of its leg is
                                         // hyperextended and not noisy

Matrix3d rotation_in_file(const Eigen::Quaterniond& turn) {
  Matrix3d file_from_world;
  for (Eigen::Index k = 0; k < 3; ++k)
    file_from_world.col(k) = opensim_from_world(Matrix3d::Identity().col(k));
  return file_from_world * turn.toRotationMatrix() * file_from_world.transpose();
}

// The angles about z, x and y with R = Rz Rx Ry, rad.
Vector3d angles_of(const Matrix3d& r) {
  const double sine = r(2, 1);
  if (std::abs(sine) > kLocked)
    return {std::atan2(r(1, 0), r(0, 0)), std::copysign(0.5 * kPi, sine), 0};
  return {std::atan2(-r(0, 1), r(1, 1)), std::asin(sine), std::atan2(-r(2, 0), r(2, 2))};
}

// Removes jumps of a whole turn, which editors would interpolate.
double unwound(double angle, double before) {
  return before + std::remainder(angle - before, 2 * kPi);
}

// The knee of a leg with these segment lengths between hip and ankle. It is bent about `hinge` (of
// any length), backwards only if it clearly was hyperextended, and straight if hip and ankle are
// too far apart.
Vector3d bent_knee(const Vector3d& hip, const Vector3d& knee, const Vector3d& ankle,
                   const Vector3d& hinge, double thigh, double shank) {
  const Vector3d way = ankle - hip;
  const double distance =
      std::clamp(way.norm(), std::abs(thigh - shank) + kShortest, thigh + shank - kShortest);
  const Vector3d down = way.normalized();
  Vector3d ahead = down.cross(hinge).normalized();
  if (ahead.dot(knee - hip) < -kHyperextended) ahead = -ahead;
  const double cosine =
      (thigh * thigh + distance * distance - shank * shank) / (2 * thigh * distance);
  const double sine = std::sqrt(std::max(0.0, 1 - cosine * cosine));
  return hip + thigh * (cosine * down + sine * ahead);
}

// Bends the leg whose hip is the node `h`, so that with the segment lengths of the rest pose the
// ankle stays where the frame has it. The foot keeps its orientation.
void keep_ankle(const AnimatedFigure& figure, size_t h, FigureFrame& frame) {
  const size_t k = h + 1, a = h + 2;
  const Matrix3d thigh(frame.turn[h]), shank = thigh * frame.turn[k].toRotationMatrix(),
                                       foot = shank * frame.turn[a].toRotationMatrix();
  const Vector3d knee = frame.offset[h] + thigh * frame.offset[k],
                 ankle = knee + shank * frame.offset[a], hip = figure.nodes[h].offset;
  if ((ankle - hip).norm() < kShortest) return;
  const Vector3d bent = bent_knee(hip, knee, ankle, thigh.col(1), figure.nodes[k].offset.norm(),
                                  figure.nodes[a].offset.norm());
  const Vector3d upper = hip - bent, lower = bent - ankle;
  const Vector3d across = upper.cross(lower).normalized();
  if (std::min(upper.norm(), lower.norm()) < kShortest) return;
  const Vector3d sideways = std::abs(across.dot(thigh.col(1))) > 0.5
                                ? (across.dot(thigh.col(1)) > 0 ? across : -across).eval()
                                : Vector3d(thigh.col(1));
  const Matrix3d new_thigh = axes_with_z(upper, sideways), new_shank = axes_with_z(lower, sideways);
  frame.turn[h] = Eigen::Quaterniond(new_thigh);
  frame.turn[k] = Eigen::Quaterniond(new_thigh.transpose() * new_shank);
  frame.turn[a] = Eigen::Quaterniond(new_shank.transpose() * foot);
}

FigureFrame with_rest_lengths(const AnimatedFigure& figure, FigureFrame frame) {
  for (size_t i = 0; i < figure.nodes.size(); ++i)
    if (figure.nodes[i].joint == Joint::kLeftHip || figure.nodes[i].joint == Joint::kRightHip)
      keep_ankle(figure, i, frame);
  return frame;
}

struct Tree {
  const AnimatedFigure& figure;
  std::string text{};

  void offset(const Vector3d& world, const std::string& indent) {
    const Vector3d at = opensim_from_world(world);
    text += indent + "OFFSET";
    for (const double each : at) append_number(text, ' ', each);
    text += "\n";
  }

  void node(size_t index, int depth) {
    const FigureNode& node = figure.nodes[index];
    const std::string indent(static_cast<size_t>(depth), '\t'), inner = indent + "\t";
    if (!node.turns)
      text += indent + "End Site\n";
    else
      text += fmt::format("{}{} {}\n", indent, depth == 0 ? "ROOT" : "JOINT", node.name);
    text += indent + "{\n";
    offset(depth == 0 ? Vector3d::Zero().eval() : node.offset, inner);
    if (node.turns)
      text += fmt::format("{}CHANNELS {}Zrotation Xrotation Yrotation\n", inner,
                          depth == 0 ? "6 Xposition Yposition Zposition " : "3 ");
    for (size_t child = index + 1; child < figure.nodes.size(); ++child)
      if (figure.nodes[child].parent == static_cast<int>(index)) this->node(child, depth + 1);
    text += indent + "}\n";
  }
};

// Lists nodes in the order of the tree.
void list_nodes(const AnimatedFigure& figure, size_t index, std::vector<size_t>& out) {
  if (figure.nodes[index].turns) out.push_back(index);
  for (size_t child = index + 1; child < figure.nodes.size(); ++child)
    if (figure.nodes[child].parent == static_cast<int>(index)) list_nodes(figure, child, out);
}

}  // namespace

std::string bvh_from_figure(const AnimatedFigure& figure, double rate) {
  if (!figure.any_frame()) return "";
  Tree tree{figure};
  tree.text = "HIERARCHY\n";
  tree.node(0, 0);
  std::string text = std::move(tree.text);
  text += fmt::format("MOTION\nFrames: {}\nFrame Time: {:.9g}\n", figure.frames.size(), 1 / rate);
  std::vector<size_t> order;
  list_nodes(figure, 0, order);
  std::vector<Vector3d> angles(order.size(), Vector3d::Zero());
  std::optional<FigureFrame> shown;
  for (const auto& frame : figure.frames)
    if (!shown && frame) shown = with_rest_lengths(figure, *frame);
  for (const auto& frame : figure.frames) {
    if (frame) shown = with_rest_lengths(figure, *frame);
    const Vector3d root = opensim_from_world(shown->root);
    std::string row;
    for (const double each : root) append_number(row, ' ', each);
    for (size_t i = 0; i < order.size(); ++i) {
      const Vector3d now = angles_of(rotation_in_file(shown->turn[order[i]]));
      for (Eigen::Index k = 0; k < 3; ++k) {
        angles[i][k] = unwound(now[k], angles[i][k]);
        append_number(row, ' ', deg_from_rad(angles[i][k]));
      }
    }
    text.append(row, 1);
    text += "\n";
  }
  return text;
}

}  // namespace io
}  // namespace walktrack
