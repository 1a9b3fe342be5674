#include "io/c3d/c3d_parameters.h"

#include <algorithm>
#include <bit>
#include <stdexcept>

#include <fmt/format.h>

namespace walktrack {
inline namespace io {

namespace {

constexpr int8_t kCharacters = -1, kWholes = 2, kReals = 4;
constexpr size_t kMostBlocks = 255;

uint8_t byte_of(size_t count) {
  if (count > kC3dMostInList)
    throw std::length_error(fmt::format("a C3D parameter of {} in a row", count));
  return static_cast<uint8_t>(count);
}

void append_byte(std::string& bytes, int value) { bytes += static_cast<char>(value); }

// Appends `head` (lengths, name and group), the offset of the next entry (0 for the last one), and
// the rest.
void append_entry(std::string& bytes, std::string_view name, int id, const std::string& rest,
                  bool last) {
  append_byte(bytes, byte_of(name.size()));
  append_byte(bytes, id);
  bytes += name;
  const size_t way = rest.size() + 2;  // offset, counted from its own position
  if (way > 0x7fff) throw std::length_error(fmt::format("C3D parameter {}", name));
  append_c3d_whole(bytes, last ? 0 : static_cast<int>(way));
  bytes += rest;
}

void append_description(std::string& bytes, const std::string& description) {
  append_byte(bytes, byte_of(description.size()));
  bytes += description;
}

std::string body_of(const C3dParameter& parameter) {
  std::string bytes;
  append_byte(bytes, parameter.type);
  append_byte(bytes, byte_of(parameter.dimensions.size()));
  for (const uint8_t each : parameter.dimensions) append_byte(bytes, each);
  bytes += parameter.data;
  append_description(bytes, parameter.description);
  return bytes;
}

// "LABELS", "LABELS2", "LABELS3", …
std::string part_name(const std::string& name, size_t part) {
  return part == 0 ? name : fmt::format("{}{}", name, part + 1);
}

size_t product(const std::vector<uint8_t>& shape) {
  size_t out = 1;
  for (const uint8_t each : shape) out *= each;
  return out;
}

template <typename Value, typename Append>
void add_numbers(C3dGroup& group, const std::string& name, std::span<const Value> values,
                 const std::vector<uint8_t>& shape, int8_t type, Append append) {
  const size_t each = product(shape), count = values.size() / each;
  for (size_t part = 0, from = 0; part == 0 || from < count; ++part, from += kC3dMostInList) {
    const size_t length = std::min(kC3dMostInList, count - from);
    C3dParameter parameter{part_name(name, part), "", type, shape, ""};
    parameter.dimensions.push_back(byte_of(length));
    for (const Value value : values.subspan(from * each, length * each))
      append(parameter.data, value);
    group.parameters.push_back(std::move(parameter));
  }
}

}  // namespace

void append_c3d_whole(std::string& bytes, int value) {
  append_byte(bytes, value & 0xff);
  append_byte(bytes, (value >> 8) & 0xff);
}

void append_c3d_real(std::string& bytes, double value) {
  const auto bits = std::bit_cast<uint32_t>(static_cast<float>(value));
  for (int shift = 0; shift < 32; shift += 8) append_byte(bytes, (bits >> shift) & 0xff);
}

void C3dGroup::text(std::string_view key, std::string_view value) {
  parameters.push_back(
      {std::string(key), "", kCharacters, {byte_of(value.size())}, std::string(value)});
}

void C3dGroup::texts(const std::string& key, std::span<const std::string> values) {
  for (size_t part = 0, from = 0; part == 0 || from < values.size();
       ++part, from += kC3dMostInList) {
    const auto some = values.subspan(from, std::min(kC3dMostInList, values.size() - from));
    size_t longest = 1;
    for (const std::string& each : some) longest = std::max(longest, each.size());
    C3dParameter parameter{
        part_name(key, part), "", kCharacters, {byte_of(longest), byte_of(some.size())}, ""};
    for (const std::string& each : some)
      parameter.data += each + std::string(longest - each.size(), ' ');
    parameters.push_back(std::move(parameter));
  }
}

void C3dGroup::whole(std::string_view key, int value) {
  parameters.push_back({std::string(key), "", kWholes, {}, ""});
  append_c3d_whole(parameters.back().data, value);
}

void C3dGroup::wholes(const std::string& key, std::span<const int> values) {
  wholes(key, values, {});
}

void C3dGroup::wholes(const std::string& key, std::span<const int> values,
                      const std::vector<uint8_t>& shape) {
  add_numbers(*this, key, values, shape, kWholes, append_c3d_whole);
}

void C3dGroup::real(std::string_view key, double value) {
  parameters.push_back({std::string(key), "", kReals, {}, ""});
  append_c3d_real(parameters.back().data, value);
}

void C3dGroup::reals(const std::string& key, std::span<const double> values,
                     const std::vector<uint8_t>& shape) {
  add_numbers(*this, key, values, shape, kReals, append_c3d_real);
}

std::string c3d_parameter_section(std::span<const C3dGroup> groups) {
  std::string entries;
  for (size_t g = 0; g < groups.size(); ++g) {
    const int id = static_cast<int>(g) + 1;
    std::string description;
    append_description(description, groups[g].description);
    append_entry(entries, groups[g].name, -id, description, false);
    const auto& parameters = groups[g].parameters;
    for (size_t p = 0; p < parameters.size(); ++p) {
      const bool last = g + 1 == groups.size() && p + 1 == parameters.size();
      append_entry(entries, parameters[p].name, id, body_of(parameters[p]), last);
    }
  }
  const size_t blocks = (4 + entries.size() + kC3dBlock - 1) / kC3dBlock;
  if (blocks > kMostBlocks) throw std::length_error("C3D parameters of more than 255 blocks");
  std::string bytes;
  append_byte(bytes, 1);
  append_byte(bytes, 0x50);
  append_byte(bytes, static_cast<int>(blocks));
  append_byte(bytes, kIntelProcessor);
  bytes += entries;
  bytes.resize(blocks * kC3dBlock, '\0');
  return bytes;
}

}  // namespace io
}  // namespace walktrack
