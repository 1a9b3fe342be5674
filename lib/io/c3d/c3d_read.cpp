#include "io/c3d/c3d_read.h"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <limits>
#include <map>

#include <fmt/format.h>

#include "core/conventions.h"
#include "core/errors.h"
#include "io/c3d/c3d_parameters.h"

namespace walktrack {
inline namespace io {

namespace {

constexpr int kAnyParameters = 0x50;

class C3dBytes {
 public:
  C3dBytes(std::string_view bytes, std::string file) : bytes_(bytes), file_(std::move(file)) {}

  [[noreturn]] void fail(const std::string& found, const std::string& allowed) const {
    throw InputError(describe({file_, 0, ""}, found, allowed));
  }
  std::string_view text(size_t at, size_t count) const {
    if (at > bytes_.size() || count > bytes_.size() - at)
      fail(fmt::format("an end after {} bytes", bytes_.size()), "a whole C3D file");
    return bytes_.substr(at, count);
  }
  int byte(size_t at) const { return static_cast<unsigned char>(text(at, 1)[0]); }
  int signed_byte(size_t at) const { return static_cast<signed char>(text(at, 1)[0]); }
  int word(size_t at) const { return byte(at) + 256 * byte(at + 1); }
  int signed_word(size_t at) const { return static_cast<int16_t>(word(at)); }
  double real(size_t at) const {
    const auto low = static_cast<uint32_t>(word(at)), high = static_cast<uint32_t>(word(at + 2));
    return std::bit_cast<float>(low | high << 16);
  }
  size_t size() const { return bytes_.size(); }
  const std::string& file() const { return file_; }

 private:
  std::string_view bytes_;
  std::string file_;
};

struct StoredParameter {
  int type = 0;
  std::vector<size_t> dimensions;
  size_t data = 0;  // offset of the data
};
using StoredParameters = std::map<std::string, StoredParameter>;  // by names such as "POINT:LABELS"

std::string upper(std::string_view text) {
  std::string out(text);
  for (char& c : out)
    if (c >= 'a' && c <= 'z') c = static_cast<char>(c - 'a' + 'A');
  return out;
}

// Groups and parameters may come in any order; each states the offset of the next one.
StoredParameters parameters_of(const C3dBytes& bytes) {
  size_t at = kC3dBlock * static_cast<size_t>(std::max(1, bytes.byte(0)) - 1);
  if (bytes.byte(1) != kAnyParameters) bytes.fail("another kind of file", "a C3D file");
  if (bytes.byte(at + 3) != kIntelProcessor)
    bytes.fail("numbers of another processor (DEC or MIPS)",
               "a little-endian C3D file; most programs that save C3D can write one");
  std::map<int, std::string> groups;
  std::map<std::pair<int, std::string>, StoredParameter> found;
  for (at += 4;;) {
    const auto letters = static_cast<size_t>(std::abs(bytes.signed_byte(at)));
    const int id = bytes.signed_byte(at + 1);
    if (letters == 0) break;
    const std::string name = upper(bytes.text(at + 2, letters));
    const size_t next = at + 2 + letters;
    size_t here = next + 2;
    if (id < 0) {
      groups[-id] = name;
    } else {
      StoredParameter parameter{bytes.signed_byte(here), {}, 0};
      const int dimensions = bytes.byte(here + 1);
      here += 2;
      for (int i = 0; i < dimensions; ++i)
        parameter.dimensions.push_back(static_cast<size_t>(bytes.byte(here++)));
      parameter.data = here;
      found[{id, name}] = parameter;
    }
    const int step = bytes.word(next);
    if (step == 0) break;
    at = next + static_cast<size_t>(step);
  }
  StoredParameters out;
  for (const auto& [key, parameter] : found)
    if (groups.contains(key.first)) out[groups[key.first] + ":" + key.second] = parameter;
  return out;
}

std::string without_padding(std::string_view text) {
  const size_t last = text.find_last_not_of(std::string_view(" \0", 2));
  return std::string(text.substr(0, last == std::string_view::npos ? 0 : last + 1));
}

// The texts of a parameter; empty if it is missing.
std::vector<std::string> texts(const C3dBytes& bytes, const StoredParameters& all,
                               const std::string& key) {
  const auto found = all.find(key);
  if (found == all.end() || found->second.type != -1 || found->second.dimensions.empty()) return {};
  const StoredParameter& parameter = found->second;
  const size_t length = parameter.dimensions[0];
  if (length == 0) return {};
  size_t count = 1;
  for (size_t i = 1; i < parameter.dimensions.size(); ++i) count *= parameter.dimensions[i];
  std::vector<std::string> out;
  for (size_t i = 0; i < count; ++i)
    out.push_back(without_padding(bytes.text(parameter.data + i * length, length)));
  return out;
}

std::vector<std::string> labels_of(const C3dBytes& bytes, const StoredParameters& all) {
  std::vector<std::string> out = texts(bytes, all, "POINT:LABELS");
  for (int k = 2; all.contains(fmt::format("POINT:LABELS{}", k)); ++k)
    for (std::string& label : texts(bytes, all, fmt::format("POINT:LABELS{}", k)))
      out.push_back(std::move(label));
  return out;
}

double metres_per(const C3dBytes& bytes, const StoredParameters& all) {
  const auto units = texts(bytes, all, "POINT:UNITS");
  if (units.empty() || units[0] == "mm") return 1e-3;
  if (units[0] == "m") return 1;
  if (units[0] == "cm") return 1e-2;
  bytes.fail(fmt::format("points in '{}'", units[0]), "m, cm or mm");
}

// The layout of the data according to the header.
struct C3dLayout {
  size_t points, start, frame_bytes, frames;
  bool floats;
  double scale, rate;
};

C3dLayout layout_of(const C3dBytes& bytes) {
  C3dLayout out{};
  out.points = static_cast<size_t>(bytes.word(2));
  const auto analog = static_cast<size_t>(bytes.word(4));  // analog values in each frame
  const int first = bytes.word(6), last = bytes.word(8);
  out.scale = bytes.real(12);
  out.floats = out.scale < 0;
  out.start = kC3dBlock * static_cast<size_t>(std::max(1, bytes.word(16)) - 1);
  out.rate = bytes.real(20);
  out.frame_bytes = (4 * out.points + analog) * (out.floats ? 4 : 2);
  if (out.points == 0 || out.frame_bytes == 0) bytes.fail("no points", "a C3D file of points");
  if (!(out.rate > 0 && out.rate < 1e5))
    bytes.fail(fmt::format("a frame rate of {:g} Hz", out.rate), "one above 0");
  if (out.start >= bytes.size()) bytes.fail("no data", "a whole C3D file");
  // The header's frame counter ends at 65,535. Longer recordings extend to the end of the file.
  const size_t there = (bytes.size() - out.start) / out.frame_bytes;
  out.frames = last >= 65535 ? there : static_cast<size_t>(std::max(0, last - first + 1));
  if (out.frames > there)
    bytes.fail(fmt::format("{} of {} frames", there, out.frames), "a whole C3D file");
  return out;
}

Eigen::Vector3d point_at(const C3dBytes& bytes, const C3dLayout& layout, size_t at, double metres) {
  const size_t width = layout.floats ? 4 : 2;
  const auto value = [&](size_t k) {
    return layout.floats ? bytes.real(at + k * width) : bytes.signed_word(at + k * width);
  };
  const double residual = value(3);
  if (!(residual >= 0)) return Eigen::Vector3d::Constant(kUnknown);
  return Eigen::Vector3d(value(0), value(1), value(2)) * (layout.floats ? 1 : layout.scale) *
         metres;
}

}  // namespace

MarkerTable markers_from_c3d(std::string_view content, const std::string& file) {
  const C3dBytes bytes(content, file);
  const StoredParameters parameters = parameters_of(bytes);
  const C3dLayout layout = layout_of(bytes);
  const double metres = metres_per(bytes, parameters);
  MarkerTable out{file, labels_of(bytes, parameters), {}, {}};
  out.names.resize(std::min(out.names.size(), layout.points));
  if (out.names.empty()) bytes.fail("points without names", "POINT:LABELS");
  for (size_t i = 0; i < layout.frames; ++i) {
    out.time.push_back(static_cast<double>(i) / layout.rate);
    auto& row = out.points.emplace_back();
    for (size_t k = 0; k < out.names.size(); ++k)
      row.push_back(point_at(
          bytes, layout, layout.start + i * layout.frame_bytes + 4 * k * (layout.floats ? 4 : 2),
          metres));
  }
  return out;
}

}  // namespace io
}  // namespace walktrack
