// The buffer of a binary glTF with its views and accessors (Khronos, glTF 2.0 specification, 3.6
// and 4.4): little-endian, every view at a multiple of four bytes.
#pragma once

#include <cstdint>
#include <span>
#include <string>

#include <nlohmann/json.hpp>

namespace walktrack {
inline namespace io {

// The purpose of a view; the values are those of the specification.
enum class GltfTarget { kNone = 0, kVertices = 34962, kIndices = 34963 };

class GltfBuffer {
 public:
  // Adds numbers, `components` for each element, as an accessor of its own; returns its index.
  // `type` is SCALAR, VEC3, VEC4 or MAT4. With `bounds` the accessor states the minimum and
  // maximum.
  int add(std::span<const float> numbers, const char* type, int components, GltfTarget target,
          bool bounds = false);
  int add(std::span<const uint16_t> indices);
  // Adds elements of four bytes.
  int add(std::span<const uint8_t> numbers);

  // The whole file: the document, to which buffers, bufferViews and accessors are added, and the
  // bytes. Throws std::length_error above 4 GiB, the limit of the format.
  std::string file(nlohmann::ordered_json document) &&;

 private:
  int accessor(size_t offset, size_t count, int component, const char* type, GltfTarget target);

  std::string bytes_;
  nlohmann::ordered_json views_ = nlohmann::ordered_json::array();
  nlohmann::ordered_json accessors_ = nlohmann::ordered_json::array();
};

}  // namespace io
}  // namespace walktrack
