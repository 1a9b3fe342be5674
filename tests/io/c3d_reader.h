// Reads C3D files as the C3D User Guide (c3d.org) describes them, independently of the writer:
// header, parameters by following their pointers, floats of the data section.
#pragma once

#include <cstdint>
#include <cstring>
#include <map>
#include <stdexcept>
#include <string>
#include <vector>

#include <Eigen/Geometry>

namespace walktrack {

struct C3dValue {
  int type = 0;
  std::vector<size_t> dimensions;
  std::vector<std::string> texts;  // without the blanks after them
  std::vector<double> numbers;
};

struct C3dPoint {
  Eigen::Vector3d at;
  double residual;
};

struct ReadC3d {
  int points = 0, analog = 0, first = 0, last = 0, data_start = 0, samples = 0, blocks = 0;
  double scale = 0, rate = 0;
  std::map<std::string, C3dValue> parameters;  // "POINT:LABELS"
  std::vector<std::vector<C3dPoint>> frames;
  std::vector<std::vector<double>> channels;  // analog values of a frame
  size_t bytes = 0;

  const C3dValue& at(const std::string& name) const { return parameters.at(name); }
  // A list that may continue as NAME2, NAME3, …
  std::vector<std::string> all_texts(const std::string& name) const {
    std::vector<std::string> out = at(name).texts;
    for (int k = 2; parameters.contains(name + std::to_string(k)); ++k)
      for (const std::string& each : at(name + std::to_string(k)).texts) out.push_back(each);
    return out;
  }
  std::vector<double> all_numbers(const std::string& name) const {
    std::vector<double> out = at(name).numbers;
    for (int k = 2; parameters.contains(name + std::to_string(k)); ++k)
      for (const double each : at(name + std::to_string(k)).numbers) out.push_back(each);
    return out;
  }
};

class C3dBytes {
 public:
  explicit C3dBytes(const std::string& bytes) : bytes_(bytes) {}
  uint8_t byte(size_t at) const { return static_cast<uint8_t>(bytes_.at(at)); }
  int8_t small(size_t at) const { return static_cast<int8_t>(bytes_.at(at)); }
  int word(size_t at) const { return byte(at) + 256 * byte(at + 1); }
  double real(size_t at) const {
    float value;
    if (at + 4 > bytes_.size()) throw std::out_of_range("C3D: the file ends too early");
    std::memcpy(&value, bytes_.data() + at, 4);
    return value;
  }
  std::string text(size_t at, size_t length) const {
    if (at + length > bytes_.size()) throw std::out_of_range("C3D: the file ends too early");
    return bytes_.substr(at, length);
  }

 private:
  const std::string& bytes_;
};

inline C3dValue read_c3d_value(const C3dBytes& bytes, size_t at) {
  C3dValue value;
  value.type = bytes.small(at);
  size_t count = 1;
  for (size_t d = 0; d < bytes.byte(at + 1); ++d) {
    value.dimensions.push_back(bytes.byte(at + 2 + d));
    count *= value.dimensions.back();
  }
  at += 2 + value.dimensions.size();
  if (value.type == -1) {
    const size_t length = value.dimensions.empty() ? 1 : value.dimensions[0];
    for (size_t i = 0; length > 0 && i < count / length; ++i) {
      std::string text = bytes.text(at + i * length, length);
      text.erase(text.find_last_not_of(' ') + 1);
      value.texts.push_back(text);
    }
  }
  for (size_t i = 0; i < count && value.type != -1; ++i) {
    if (value.type == 1) value.numbers.push_back(bytes.byte(at + i));
    if (value.type == 2) value.numbers.push_back(bytes.word(at + 2 * i));
    if (value.type == 4) value.numbers.push_back(bytes.real(at + 4 * i));
  }
  return value;
}

inline void read_c3d_parameters(const C3dBytes& bytes, size_t start, ReadC3d& out) {
  if (bytes.byte(start + 1) != 0x50) throw std::runtime_error("C3D: no parameter section");
  if (bytes.byte(start + 3) != 84) throw std::runtime_error("C3D: not little-endian");
  out.blocks = bytes.byte(start + 2);
  std::map<int, std::string> groups;
  std::map<std::pair<int, std::string>, C3dValue> values;
  for (size_t at = start + 4;;) {
    const size_t length = static_cast<size_t>(std::abs(bytes.small(at)));
    if (length == 0) break;
    const int id = bytes.small(at + 1);
    const std::string name = bytes.text(at + 2, length);
    const size_t pointer = at + 2 + length;
    if (id < 0)
      groups[-id] = name;
    else
      values[{id, name}] = read_c3d_value(bytes, pointer + 2);
    const int way = bytes.word(pointer);
    if (way == 0) break;
    at = pointer + static_cast<size_t>(way);
    if (at >= start + 512 * static_cast<size_t>(out.blocks))
      throw std::runtime_error("C3D: a parameter outside its section");
  }
  for (auto& [key, value] : values)
    out.parameters[groups.at(key.first) + ":" + key.second] = std::move(value);
}

inline ReadC3d read_c3d(const std::string& text) {
  const C3dBytes bytes(text);
  if (bytes.byte(1) != 0x50) throw std::runtime_error("C3D: not a C3D file");
  ReadC3d out;
  out.bytes = text.size();
  out.points = bytes.word(2);
  out.analog = bytes.word(4);
  out.first = bytes.word(6);
  out.last = bytes.word(8);
  out.scale = bytes.real(12);
  out.data_start = bytes.word(16);
  out.samples = bytes.word(18);
  out.rate = bytes.real(20);
  read_c3d_parameters(bytes, 512 * (static_cast<size_t>(bytes.byte(0)) - 1), out);
  if (out.scale >= 0) throw std::runtime_error("C3D: whole numbers");
  const auto field = [&](const std::string& name) {
    const auto& words = out.at("TRIAL:ACTUAL_" + name + "_FIELD").numbers;
    return static_cast<int>(words.at(0) + 65536 * words.at(1));
  };
  const int frames = field("END") - field("START") + 1;
  size_t at = 512 * (static_cast<size_t>(out.data_start) - 1);
  for (int i = 0; i < frames; ++i) {
    std::vector<C3dPoint>& points = out.frames.emplace_back();
    for (int p = 0; p < out.points; ++p, at += 16)
      points.push_back(
          {{bytes.real(at), bytes.real(at + 4), bytes.real(at + 8)}, bytes.real(at + 12)});
    std::vector<double>& channels = out.channels.emplace_back();
    for (int c = 0; c < out.analog; ++c, at += 4) channels.push_back(bytes.real(at));
  }
  return out;
}

// The values of a plate of type 2 in the laboratory's axes: the vector as it is stored, rotated,
// and the centre of pressure.
struct PlateReading {
  Eigen::Vector3d force, centre;
  double free_moment;  // about the vertical through the centre
};

inline PlateReading read_plate(const ReadC3d& file, size_t plate, size_t frame) {
  const auto& corners = file.at("FORCE_PLATFORM:CORNERS").numbers;
  const auto corner = [&](size_t k) {
    const size_t at = 12 * plate + 3 * k;
    return Eigen::Vector3d(corners.at(at), corners.at(at + 1), corners.at(at + 2));
  };
  const Eigen::Vector3d x = (corner(0) - corner(1)).normalized(),
                        y = (corner(0) - corner(3)).normalized(), z = x.cross(y);
  const auto channel = [&](size_t k) {
    const double number = file.at("FORCE_PLATFORM:CHANNEL").numbers.at(6 * plate + k);
    return file.channels.at(frame).at(static_cast<size_t>(number) - 1);
  };
  const Eigen::Vector3d force(channel(0), channel(1), channel(2)),
      moment(channel(3), channel(4), channel(5));
  const Eigen::Vector3d at(-moment.y() / force.z(), moment.x() / force.z(), 0);
  const Eigen::Vector3d middle = 0.25 * (corner(0) + corner(1) + corner(2) + corner(3));
  Eigen::Matrix3d turn;
  turn << x, y, z;
  return {turn * force, turn * at + middle, (turn * (moment - at.cross(force))).z()};
}

}  // namespace walktrack
