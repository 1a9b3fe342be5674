#include "io/figure/gltf_buffer.h"

#include <algorithm>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <vector>

namespace walktrack {
inline namespace io {

namespace {

using Json = nlohmann::ordered_json;

constexpr int kUnsignedByte = 5121, kUnsignedShort = 5123, kFloat = 5126;
constexpr uint32_t kMagic = 0x46546C67, kJsonChunk = 0x4E4F534A, kBinaryChunk = 0x004E4942;

void append_word(std::string& bytes, uint32_t word) {
  for (int shift = 0; shift < 32; shift += 8) bytes += static_cast<char>((word >> shift) & 0xff);
}

void append_half(std::string& bytes, uint16_t half) {
  for (int shift = 0; shift < 16; shift += 8) bytes += static_cast<char>((half >> shift) & 0xff);
}

void append_float(std::string& bytes, float value) {
  uint32_t word = 0;
  std::memcpy(&word, &value, sizeof word);
  append_word(bytes, word);
}

void pad(std::string& bytes, char with) { bytes.resize((bytes.size() + 3) / 4 * 4, with); }

// Adds the smallest and the largest value of each component.
void add_bounds(std::span<const float> numbers, int components, Json& accessor) {
  const auto width = static_cast<size_t>(components);
  std::vector<float> low(numbers.begin(), numbers.begin() + components), high = low;
  for (size_t i = width; i < numbers.size(); ++i) {
    low[i % width] = std::min(low[i % width], numbers[i]);
    high[i % width] = std::max(high[i % width], numbers[i]);
  }
  accessor["min"] = std::vector<double>(low.begin(), low.end());
  accessor["max"] = std::vector<double>(high.begin(), high.end());
}

}  // namespace

int GltfBuffer::accessor(size_t offset, size_t count, int component, const char* type,
                         GltfTarget target) {
  Json view{{"buffer", 0}, {"byteOffset", offset}, {"byteLength", bytes_.size() - offset}};
  if (target != GltfTarget::kNone) view["target"] = static_cast<int>(target);
  accessors_.push_back({{"bufferView", views_.size()},
                        {"componentType", component},
                        {"count", count},
                        {"type", type}});
  views_.push_back(std::move(view));
  pad(bytes_, '\0');
  return static_cast<int>(accessors_.size()) - 1;
}

int GltfBuffer::add(std::span<const float> numbers, const char* type, int components,
                    GltfTarget target, bool bounds) {
  const size_t offset = bytes_.size();
  for (const float each : numbers) append_float(bytes_, each);
  const int out =
      accessor(offset, numbers.size() / static_cast<size_t>(components), kFloat, type, target);
  if (bounds) add_bounds(numbers, components, accessors_.back());
  return out;
}

int GltfBuffer::add(std::span<const uint16_t> indices) {
  const size_t offset = bytes_.size();
  for (const uint16_t each : indices) append_half(bytes_, each);
  return accessor(offset, indices.size(), kUnsignedShort, "SCALAR", GltfTarget::kIndices);
}

int GltfBuffer::add(std::span<const uint8_t> numbers) {
  const size_t offset = bytes_.size();
  for (const uint8_t each : numbers) bytes_ += static_cast<char>(each);
  return accessor(offset, numbers.size() / 4, kUnsignedByte, "VEC4", GltfTarget::kVertices);
}

std::string GltfBuffer::file(Json document) && {
  document["accessors"] = std::move(accessors_);
  document["bufferViews"] = std::move(views_);
  document["buffers"] = Json::array({{{"byteLength", bytes_.size()}}});
  std::string text = document.dump(-1, ' ', false, Json::error_handler_t::replace);
  pad(text, ' ');
  const size_t total = 12 + 8 + text.size() + 8 + bytes_.size();
  if (total > std::numeric_limits<uint32_t>::max())
    throw std::length_error("a binary glTF of more than 4 GiB");
  std::string out;
  out.reserve(total);
  append_word(out, kMagic);
  append_word(out, 2);
  append_word(out, static_cast<uint32_t>(total));
  append_word(out, static_cast<uint32_t>(text.size()));
  append_word(out, kJsonChunk);
  out += text;
  append_word(out, static_cast<uint32_t>(bytes_.size()));
  append_word(out, kBinaryChunk);
  return out + bytes_;
}

}  // namespace io
}  // namespace walktrack
