// The parameter section of a C3D file: named values in groups (C3D User Guide, c3d.org, "The
// Parameter Section"), little-endian.
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace walktrack {
inline namespace io {

inline constexpr int kIntelProcessor = 84;  // 83 + 1: little-endian, IEEE floats

inline constexpr size_t kC3dBlock = 512;  // bytes: all sections are whole blocks
inline constexpr size_t kC3dMostInList = 255;

struct C3dParameter {
  std::string name, description;
  int8_t type;                      // -1 characters, 1 bytes, 2 16-bit, 4 32-bit float
  std::vector<uint8_t> dimensions;  // none: one value; fastest first
  std::string data;                 // dimensions' product times |type| bytes
};

struct C3dGroup {
  std::string name, description;
  std::vector<C3dParameter> parameters{};

  void text(std::string_view key, std::string_view value);
  // A list of more than kC3dMostInList texts is continued under the same name with 2, 3, …
  // appended, as the guide describes for POINT:LABELS2.
  void texts(const std::string& key, std::span<const std::string> values);
  // Stored unsigned, 0 to 65535, as readers expect it for these keys.
  void whole(std::string_view key, int value);
  void wholes(const std::string& key, std::span<const int> values);
  void real(std::string_view key, double value);
  // `shape`: the dimensions before the last one, which may have any length.
  void reals(const std::string& key, std::span<const double> values,
             const std::vector<uint8_t>& shape = {});
  void wholes(const std::string& key, std::span<const int> values,
              const std::vector<uint8_t>& shape);
};

// Whole blocks. Throws std::length_error if there are more than the format can count (255).
std::string c3d_parameter_section(std::span<const C3dGroup> groups);

// Little-endian bytes of numbers.
void append_c3d_whole(std::string& bytes, int value);
void append_c3d_real(std::string& bytes, double value);

}  // namespace io
}  // namespace walktrack
