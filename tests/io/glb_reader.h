// Reads binary glTF 2.0 according to its specification, independently of the writer: chunks,
// accessors with the rules for their alignment and bounds, the animation at a time, and the
// positions of skinned vertices.
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>
#include <nlohmann/json.hpp>

namespace walktrack {

struct GlbPose {
  std::map<std::string, Eigen::Affine3d> nodes;  // world, by name
  Eigen::Vector3d place(const std::string& name) const { return nodes.at(name).translation(); }
};

class ReadGlb {
 public:
  explicit ReadGlb(const std::string& bytes) : bytes_(bytes) {
    EXPECT_EQ(word(0), 0x46546C67u);
    EXPECT_EQ(word(4), 2u);
    EXPECT_EQ(word(8), bytes.size());
    const size_t length = word(12);
    EXPECT_EQ(word(16), 0x4E4F534Au);
    EXPECT_EQ(length % 4, 0u);
    json = nlohmann::json::parse(bytes.substr(20, length));
    data_ = 20 + length + 8;
    EXPECT_EQ(word(data_ - 8), bytes.size() - data_);
    EXPECT_EQ(word(data_ - 4), 0x004E4942u);
    EXPECT_EQ((bytes.size() - data_) % 4, 0u);
    EXPECT_EQ(json.at("asset").at("version"), "2.0");
    EXPECT_EQ(json.at("buffers").size(), 1u);
    const size_t stated = json["buffers"][0].at("byteLength");
    EXPECT_LE(stated, bytes.size() - data_);
    EXPECT_LE(bytes.size() - data_ - stated, 3u);
  }

  // The numbers of an accessor, element by element.
  std::vector<double> numbers(size_t index) const {
    const auto& accessor = json.at("accessors").at(index);
    const auto& view = json.at("bufferViews").at(accessor.at("bufferView").get<size_t>());
    const size_t size = component_size(accessor.at("componentType")),
                 width = components(accessor.at("type")), count = accessor.at("count");
    const size_t offset = accessor.value("byteOffset", size_t{0});
    const size_t start = view.value("byteOffset", size_t{0}) + offset;
    EXPECT_FALSE(view.contains("byteStride"));
    EXPECT_EQ(start % size, 0u) << "alignment";
    if (view.contains("target") && view["target"] == 34962) {
      EXPECT_EQ(start % 4, 0u);
      EXPECT_EQ(width * size % 4, 0u);
    }
    EXPECT_GT(count, 0u);
    EXPECT_LE(offset + count * width * size, view.at("byteLength").get<size_t>());
    EXPECT_LE(view.value("byteOffset", size_t{0}) + view.at("byteLength").get<size_t>(),
              json["buffers"][0]["byteLength"].get<size_t>());
    std::vector<double> out;
    for (size_t i = 0; i < count * width; ++i)
      out.push_back(number(data_ + start + i * size, size));
    if (accessor.contains("min")) check_bounds(accessor, out, width);
    return out;
  }

  // Every node at a time, with keys interpolated according to their sampler.
  GlbPose at(double time) const {
    const auto& nodes = json.at("nodes");
    std::vector<Eigen::Vector3d> place(nodes.size(), Eigen::Vector3d::Zero()),
        scale(nodes.size(), Eigen::Vector3d::Ones());
    std::vector<Eigen::Quaterniond> turn(nodes.size(), Eigen::Quaterniond::Identity());
    for (size_t i = 0; i < nodes.size(); ++i)
      if (nodes[i].contains("translation"))
        for (size_t k = 0; k < 3; ++k)
          place[i][static_cast<Eigen::Index>(k)] = nodes[i]["translation"][k];
    const auto& animation = json.at("animations").at(0);
    for (const auto& channel : animation.at("channels")) {
      const auto& sampler = animation.at("samplers").at(channel.at("sampler").get<size_t>());
      const size_t node = channel.at("target").at("node");
      const std::string path = channel["target"].at("path");
      const std::vector<double> value = sampled(sampler, time, path == "rotation");
      if (path == "rotation")
        turn[node] = Eigen::Quaterniond(value[3], value[0], value[1], value[2]);
      else
        (path == "scale" ? scale : place)[node] = Eigen::Vector3d(value.data());
    }
    std::vector<size_t> parent(nodes.size(), nodes.size());
    for (size_t i = 0; i < nodes.size(); ++i)
      for (const auto& child : nodes[i].value("children", nlohmann::json::array()))
        parent.at(child.get<size_t>()) = i;
    GlbPose out;
    for (size_t i = 0; i < nodes.size(); ++i) {
      Eigen::Affine3d pose = Eigen::Affine3d::Identity();
      for (size_t at = i; at < nodes.size(); at = parent[at])
        pose = Eigen::Translation3d(place[at]) * turn[at] * Eigen::Scaling(scale[at]) * pose;
      out.nodes[nodes[i].at("name")] = pose;
    }
    return out;
  }

  nlohmann::json json;

 private:
  static size_t component_size(int type) {
    return type == 5121   ? 1
           : type == 5123 ? 2
           : type == 5126 ? 4
                          : throw std::runtime_error("type");
  }
  static size_t components(const std::string& type) {
    const std::map<std::string, size_t> known{
        {"SCALAR", 1}, {"VEC3", 3}, {"VEC4", 4}, {"MAT4", 16}};
    return known.at(type);
  }
  uint32_t word(size_t at) const {
    uint32_t out = 0;
    for (size_t k = 4; k-- > 0;) out = out << 8 | static_cast<uint8_t>(bytes_.at(at + k));
    return out;
  }
  double number(size_t at, size_t size) const {
    if (size == 1) return static_cast<uint8_t>(bytes_.at(at));
    if (size == 2)
      return static_cast<uint8_t>(bytes_.at(at)) + 256 * static_cast<uint8_t>(bytes_.at(at + 1));
    const uint32_t bits = word(at);
    float out;
    std::memcpy(&out, &bits, 4);
    EXPECT_TRUE(std::isfinite(out));
    return static_cast<double>(out);
  }
  static void check_bounds(const nlohmann::json& accessor, const std::vector<double>& numbers,
                           size_t width) {
    for (size_t k = 0; k < width; ++k) {
      double low = numbers[k], high = numbers[k];
      for (size_t i = k; i < numbers.size(); i += width) {
        low = std::min(low, numbers[i]);
        high = std::max(high, numbers[i]);
      }
      EXPECT_EQ(accessor.at("min").at(k).get<double>(), low);
      EXPECT_EQ(accessor.at("max").at(k).get<double>(), high);
    }
  }
  std::vector<double> sampled(const nlohmann::json& sampler, double time, bool turn) const {
    const std::vector<double> times = numbers(sampler.at("input").get<size_t>()),
                              values = numbers(sampler.at("output").get<size_t>());
    const size_t width = values.size() / times.size();
    const auto key = [&](size_t i) {
      return std::vector<double>(values.begin() + static_cast<ptrdiff_t>(i * width),
                                 values.begin() + static_cast<ptrdiff_t>((i + 1) * width));
    };
    size_t next = 0;
    while (next < times.size() && times[next] <= time) ++next;
    if (next == 0) return key(0);
    if (next == times.size() || sampler.at("interpolation") == "STEP") return key(next - 1);
    const double share = (time - times[next - 1]) / (times[next] - times[next - 1]);
    std::vector<double> from = key(next - 1), to = key(next);
    if (turn) {
      const Eigen::Quaterniond q =
          Eigen::Quaterniond(from.data()).slerp(share, Eigen::Quaterniond(to.data()));
      return {q.x(), q.y(), q.z(), q.w()};
    }
    for (size_t i = 0; i < width; ++i) from[i] += share * (to[i] - from[i]);
    return from;
  }

  const std::string& bytes_;
  size_t data_ = 0;
};

}  // namespace walktrack
