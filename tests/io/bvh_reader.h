// Reads BVH files independently of the writer, and computes the positions of their joints: forward
// kinematics according to "Motion Capture File Formats Explained" (Meredith & Maddock 2001), with
// channels in their order.
#pragma once

#include <map>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Geometry>

namespace walktrack {

struct BvhNode {
  std::string name;  // for an end site: its parent's with "/end" appended
  int parent = -1;
  Eigen::Vector3d offset{0, 0, 0};
  std::vector<std::string> channels{};
};

struct ReadBvh {
  std::vector<BvhNode> nodes;
  double frame_time = 0;
  std::vector<std::vector<double>> frames;

  // By node, in the file's axes.
  std::map<std::string, Eigen::Vector3d> places(size_t frame) const {
    std::map<std::string, Eigen::Vector3d> out;
    std::vector<Eigen::Isometry3d> poses;
    size_t next = 0;
    for (const BvhNode& node : nodes) {
      Eigen::Isometry3d pose =
          node.parent < 0 ? Eigen::Isometry3d::Identity() : poses[static_cast<size_t>(node.parent)];
      pose.translate(node.offset);
      for (const std::string& channel : node.channels) {
        const double value = frames.at(frame).at(next++);
        const Eigen::Vector3d axis = Eigen::Vector3d::Unit(channel.at(0) - 'X');
        if (channel.ends_with("position"))
          pose.translate(value * axis);
        else
          pose.rotate(Eigen::AngleAxisd(value * std::numbers::pi / 180, axis));
      }
      poses.push_back(pose);
      out[node.name] = pose.translation();
    }
    return out;
  }
};

inline ReadBvh read_bvh(const std::string& text) {
  std::istringstream stream(text);
  std::string word;
  const auto expect = [&](const std::string& wanted) {
    if (!(stream >> word) || word != wanted)
      throw std::runtime_error("BVH: '" + word + "', not " + wanted);
  };
  ReadBvh out;
  std::vector<int> open;
  size_t channels = 0;
  expect("HIERARCHY");
  while (stream >> word && word != "MOTION") {
    if (word == "ROOT" || word == "JOINT" || word == "End") {
      BvhNode node{"", open.empty() ? -1 : open.back()};
      std::string name;
      stream >> name;
      node.name = word == "End" ? out.nodes[static_cast<size_t>(node.parent)].name + "/end" : name;
      if ((word == "ROOT") != out.nodes.empty()) throw std::runtime_error("BVH: one root");
      out.nodes.push_back(node);
      expect("{");
      open.push_back(static_cast<int>(out.nodes.size()) - 1);
    } else if (word == "OFFSET") {
      for (double& each : out.nodes.back().offset) stream >> each;
    } else if (word == "CHANNELS") {
      size_t count = 0;
      stream >> count;
      channels += count;
      for (; count > 0; --count) {
        stream >> word;
        out.nodes.back().channels.push_back(word);
      }
    } else if (word == "}") {
      open.pop_back();
    } else {
      throw std::runtime_error("BVH: '" + word + "'");
    }
  }
  size_t frames = 0;
  expect("Frames:");
  stream >> frames;
  expect("Frame");
  expect("Time:");
  stream >> out.frame_time;
  stream >> std::ws;
  for (std::string line; std::getline(stream, line);) {
    std::istringstream cells(line);
    std::vector<double>& row = out.frames.emplace_back();
    for (double value = 0; cells >> value;) row.push_back(value);
    if (row.size() != channels || !cells.eof()) throw std::runtime_error("BVH: a row's numbers");
  }
  if (!open.empty() || out.frames.size() != frames) throw std::runtime_error("BVH: counts");
  return out;
}

}  // namespace walktrack
