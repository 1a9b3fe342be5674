#include "io/figure/glb_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <optional>
#include <vector>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "body/joint_angles.h"
#include "core/version.h"
#include "io/figure/figure_mesh.h"
#include "io/figure/gltf_buffer.h"

namespace walktrack {
inline namespace io {

namespace {

using Eigen::Quaterniond;
using Eigen::Vector3d;
using Json = nlohmann::ordered_json;

void append(std::vector<float>& out, const Vector3d& world) {
  for (const double each : opensim_from_world(world)) out.push_back(static_cast<float>(each));
}

std::vector<double> list_of(const Vector3d& world) {
  const Vector3d at = opensim_from_world(world);
  return {at.x(), at.y(), at.z()};
}

// Consecutive quaternions get the same sign, so that interpolation takes the shorter rotation.
void append(std::vector<float>& out, const Quaterniond& turn, Quaterniond& before) {
  const double sign = turn.dot(before) < 0 ? -1 : 1;
  before = Quaterniond(sign * turn.coeffs());
  append(out, before.vec());
  out.push_back(static_cast<float>(before.w()));
}

struct Key {
  float time;
  const FigureFrame* frame;
};

std::vector<Key> keys_of(const AnimatedFigure& figure) {
  std::vector<Key> out;
  for (size_t i = 0; i < figure.frames.size(); ++i) {
    const auto time = static_cast<float>(figure.time[i]);
    if (!figure.frames[i] || (!out.empty() && !(time > out.back().time))) continue;
    out.push_back({time, &*figure.frames[i]});
  }
  return out;
}

class Animation {
 public:
  Animation(const std::vector<Key>& keys, GltfBuffer& buffer) : keys_(keys), buffer_(buffer) {
    times_ = add_times([&] {
      std::vector<float> times;
      for (const Key& key : keys) times.push_back(key.time);
      return times;
    }());
  }

  void add_places(size_t node, const std::function<Vector3d(const FigureFrame&)>& place) {
    std::vector<float> numbers;
    for (const Key& key : keys_) append(numbers, place(*key.frame));
    add_channel(node, "translation", times_, buffer_.add(numbers, "VEC3", 3, GltfTarget::kNone),
                "LINEAR");
  }

  void add_turns(size_t node) {
    std::vector<float> numbers;
    Quaterniond before = Quaterniond::Identity();
    for (const Key& key : keys_) append(numbers, key.frame->turn[node], before);
    add_channel(node, "rotation", times_, buffer_.add(numbers, "VEC4", 4, GltfTarget::kNone),
                "LINEAR");
  }

  // A node is visible in frames that have a pose.
  void add_presence(size_t node, const AnimatedFigure& figure) {
    std::vector<float> times, scales;
    std::optional<bool> before;
    for (size_t i = 0; i < figure.frames.size(); ++i) {
      const bool seen = figure.frames[i].has_value();
      const auto time = static_cast<float>(figure.time[i]);
      if (seen == before || (!times.empty() && !(time > times.back()))) continue;
      times.push_back(time);
      scales.insert(scales.end(), 3, seen ? 1.0F : 0.0F);
      before = seen;
    }
    if (times.size() == 1 && scales[0] == 1) return;
    const int input = add_times(times);
    add_channel(node, "scale", input, buffer_.add(scales, "VEC3", 3, GltfTarget::kNone), "STEP");
  }

  Json json() && {
    return {
        {"name", "walk"}, {"channels", std::move(channels_)}, {"samplers", std::move(samplers_)}};
  }

 private:
  int add_times(const std::vector<float>& times) {
    return buffer_.add(times, "SCALAR", 1, GltfTarget::kNone, true);
  }

  void add_channel(size_t node, const char* path, int input, int output, const char* between) {
    channels_.push_back(
        {{"sampler", samplers_.size()}, {"target", {{"node", node}, {"path", path}}}});
    samplers_.push_back({{"input", input}, {"output", output}, {"interpolation", between}});
  }

  const std::vector<Key>& keys_;
  GltfBuffer& buffer_;
  int times_ = 0;
  Json channels_ = Json::array(), samplers_ = Json::array();
};

bool changes(const std::vector<Key>& keys, size_t node, const Vector3d& mean) {
  return std::any_of(keys.begin(), keys.end(), [&](const Key& key) {
    return (key.frame->offset[node] - mean).norm() > kSteadyLength;
  });
}

Json animation_of(const AnimatedFigure& figure, GltfBuffer& buffer) {
  const std::vector<Key> keys = keys_of(figure);
  Animation out(keys, buffer);
  out.add_places(0, [](const FigureFrame& frame) { return frame.root; });
  for (size_t i = 0; i < figure.nodes.size(); ++i) {
    if (figure.nodes[i].turns) out.add_turns(i);
    if (i > 0 && changes(keys, i, figure.nodes[i].offset))
      out.add_places(i, [i](const FigureFrame& frame) { return frame.offset[i]; });
  }
  out.add_presence(0, figure);
  return std::move(out).json();
}

Json nodes_of(const AnimatedFigure& figure, const std::vector<Vector3d>& rest) {
  Json out = Json::array();
  for (size_t i = 0; i < figure.nodes.size(); ++i) {
    Json node{{"name", figure.nodes[i].name},
              {"translation", list_of(i == 0 ? rest[0] : figure.nodes[i].offset)}};
    for (size_t child = i + 1; child < figure.nodes.size(); ++child)
      if (figure.nodes[child].parent == static_cast<int>(i)) node["children"].push_back(child);
    out.push_back(std::move(node));
  }
  out.push_back({{"name", "figure"}, {"mesh", 0}, {"skin", 0}});
  return out;
}

// At rest a joint's axes are the world's: the inverse bind matrix subtracts its position, column by
// column.
Json skin_of(const std::vector<Vector3d>& rest, GltfBuffer& buffer) {
  std::vector<float> matrices;
  Json joints = Json::array();
  for (size_t i = 0; i < rest.size(); ++i) {
    joints.push_back(i);
    for (int column = 0; column < 3; ++column)
      for (int row = 0; row < 4; ++row) matrices.push_back(row == column ? 1.0F : 0.0F);
    append(matrices, -rest[i]);
    matrices.push_back(1);
  }
  return {{"inverseBindMatrices", buffer.add(matrices, "MAT4", 16, GltfTarget::kNone)},
          {"skeleton", 0},
          {"joints", std::move(joints)}};
}

Json mesh_json(const FigureMesh& mesh, GltfBuffer& buffer) {
  std::vector<float> places, normals, weights;
  std::vector<uint8_t> joints;
  for (size_t i = 0; i < mesh.places.size(); ++i) {
    append(places, mesh.places[i]);
    append(normals, mesh.normals[i]);
    joints.insert(joints.end(), {mesh.nodes[i], 0, 0, 0});
    weights.insert(weights.end(), {1, 0, 0, 0});
  }
  const Json attributes{{"POSITION", buffer.add(places, "VEC3", 3, GltfTarget::kVertices, true)},
                        {"NORMAL", buffer.add(normals, "VEC3", 3, GltfTarget::kVertices)},
                        {"JOINTS_0", buffer.add(joints)},
                        {"WEIGHTS_0", buffer.add(weights, "VEC4", 4, GltfTarget::kVertices)}};
  Json primitives = Json::array();
  for (size_t group = 0; group < kMeshGroupCount; ++group)
    primitives.push_back({{"attributes", attributes},
                          {"indices", buffer.add(mesh.triangles[group])},
                          {"material", group}});
  return {{"name", "figure"}, {"primitives", std::move(primitives)}};
}

// Colours are sRGB from 0 to 255, as the overlay draws them; glTF uses linear colours.
Json material(const char* name, const std::array<int, 3>& colour) {
  const auto linear = [](int value) { return std::pow(value / 255.0, 2.2); };
  const std::array factor{linear(colour[0]), linear(colour[1]), linear(colour[2]), 1.0};
  return {{"name", name},
          {"pbrMetallicRoughness",
           {{"baseColorFactor", factor}, {"metallicFactor", 0}, {"roughnessFactor", 0.8}}}};
}

}  // namespace

std::string glb_from_figure(const AnimatedFigure& figure, const Subject& subject) {
  if (!figure.any_frame()) return "";
  const Body body = body_of_figure(figure, subject);
  const std::vector<Vector3d> rest = rest_places(figure, body.lengths.ankle_height);
  GltfBuffer buffer;
  Json document{
      {"asset",
       {{"version", "2.0"}, {"generator", fmt::format("walktrack {}", build_facts().version)}}},
      {"scene", 0},
      {"scenes", Json::array({{{"name", "walk"}, {"nodes", {0, figure.nodes.size()}}}})},
      {"nodes", nodes_of(figure, rest)},
      {"meshes", Json::array({mesh_json(mesh_of(figure, body), buffer)})},
      {"materials",
       Json::array({material("trunk", {200, 200, 200}), material("left", {0, 114, 178}),
                    material("right", {213, 94, 0})})}};
  document["skins"] = Json::array({skin_of(rest, buffer)});
  document["animations"] = Json::array({animation_of(figure, buffer)});
  return std::move(buffer).file(std::move(document));
}

}  // namespace io
}  // namespace walktrack
