#include "observation/pose_net/net_file.h"

#include <cstdint>
#include <cstring>
#include <vector>

#include <Eigen/Core>

#include "core/errors.h"

namespace walktrack {
inline namespace observation {

namespace {

// Wire types of protocol buffers, and the fields that are used.
constexpr int kVarint = 0, kEight = 1, kPacket = 2, kFour = 5;
constexpr int kModelGraph = 7;
constexpr int kGraphTensor = 5, kGraphInput = 11;
constexpr int kTensorType = 2, kTensorContent = 9;
constexpr uint64_t kFloat = 1, kHalf = 10;
constexpr int kInfoType = 2, kTypeTensor = 1, kTensorShape = 2, kShapeSize = 1, kSizeValue = 1;
constexpr int kSmallest_px = 32, kLargest_px = 1024;

struct Broken {};  // not a protocol buffer

struct Field {
  int number = 0, wire = 0;
  uint64_t value = 0;         // of a varint
  std::string_view content;   // of a packet
  std::string_view complete;  // with its key, as in the file
};

uint64_t take_varint(std::string_view& rest) {
  uint64_t value = 0;
  for (int shift = 0; shift < 64 && !rest.empty(); shift += 7) {
    const auto byte = static_cast<uint8_t>(rest.front());
    rest.remove_prefix(1);
    value |= static_cast<uint64_t>(byte & 127) << shift;
    if (byte < 128) return value;
  }
  throw Broken();
}

std::string_view take_bytes(std::string_view& rest, uint64_t count) {
  if (count > rest.size()) throw Broken();
  const std::string_view out = rest.substr(0, count);
  rest.remove_prefix(count);
  return out;
}

Field take_field(std::string_view& rest) {
  const std::string_view start = rest;
  const uint64_t key = take_varint(rest);
  Field field{static_cast<int>(key >> 3), static_cast<int>(key & 7), 0, {}, {}};
  if (field.wire == kVarint) {
    field.value = take_varint(rest);
  } else if (field.wire == kPacket) {
    const uint64_t count = take_varint(rest);
    field.content = take_bytes(rest, count);
  } else if (field.wire == kFour || field.wire == kEight) {
    take_bytes(rest, field.wire == kFour ? 4 : 8);
  } else {
    throw Broken();
  }
  field.complete = start.substr(0, start.size() - rest.size());
  return field;
}

template <typename F>
void for_fields(std::string_view message, const F& f) {
  while (!message.empty()) f(take_field(message));
}

void append_varint(std::string& out, uint64_t value) {
  for (; value > 127; value >>= 7) out += static_cast<char>((value & 127) | 128);
  out += static_cast<char>(value);
}

void append_packet(std::string& out, int number, std::string_view content) {
  append_varint(out, static_cast<uint64_t>(number) << 3 | kPacket);
  append_varint(out, content.size());
  out += content;
}

std::string widened_numbers(std::string_view halves) {
  std::string out(2 * halves.size(), '\0');
  for (size_t i = 0; i + 1 < halves.size(); i += 2) {
    uint16_t bits = 0;
    std::memcpy(&bits, halves.data() + i, sizeof bits);
    const auto wide = static_cast<float>(Eigen::numext::bit_cast<Eigen::half>(bits));
    std::memcpy(out.data() + 2 * i, &wide, sizeof wide);
  }
  return out;
}

bool is_half(std::string_view tensor) {
  bool half = false;
  for_fields(tensor, [&](const Field& field) {
    if (field.number == kTensorType) half = field.value == kHalf;
  });
  return half;
}

std::string widened_tensor(std::string_view tensor) {
  if (!is_half(tensor)) return std::string(tensor);
  std::string out;
  for_fields(tensor, [&](const Field& field) {
    if (field.number == kTensorType) {
      append_varint(out, static_cast<uint64_t>(kTensorType) << 3 | kVarint);
      append_varint(out, kFloat);
    } else if (field.number == kTensorContent) {
      append_packet(out, kTensorContent, widened_numbers(field.content));
    } else {
      out += field.complete;
    }
  });
  return out;
}

// The packet in that field; empty if there is none.
std::string_view inner(std::string_view message, int number) {
  std::string_view out;
  for_fields(message, [&](const Field& field) {
    if (field.number == number) out = field.content;
  });
  return out;
}

// The side of an input with the shape 1 x 3 x side x side.
int side_of(std::string_view input) {
  const std::string_view shape = inner(inner(inner(input, kInfoType), kTypeTensor), kTensorShape);
  std::vector<uint64_t> sizes;
  for_fields(shape, [&](const Field& size) {
    if (size.number == kShapeSize)
      for_fields(size.content, [&](const Field& value) {
        if (value.number == kSizeValue) sizes.push_back(value.value);
      });
  });
  const bool square = sizes.size() == 4 && sizes[1] == 3 && sizes[2] == sizes[3];
  if (!square || sizes[3] < kSmallest_px || sizes[3] > kLargest_px) return 0;
  return static_cast<int>(sizes[3]);
}

NetFile widened_model(std::string_view file) {
  NetFile out;
  for_fields(file, [&](const Field& field) {
    if (field.number != kModelGraph || field.wire != kPacket) {
      out.onnx += field.complete;
      return;
    }
    std::string graph;
    for_fields(field.content, [&](const Field& part) {
      if (part.number == kGraphInput) out.side_px = side_of(part.content);
      if (part.number == kGraphTensor) {
        append_packet(graph, kGraphTensor, widened_tensor(part.content));
      } else {
        graph += part.complete;
      }
    });
    append_packet(out.onnx, kModelGraph, graph);
  });
  return out;
}

}  // namespace

NetFile widened_net(std::string_view file, const std::string& name) {
  const std::string allowed = "an ONNX file of a pose network with one square picture as input";
  NetFile out;
  try {
    out = widened_model(file);
  } catch (const Broken&) {
    throw InputError(describe({name, 0, ""}, "no ONNX file", allowed));
  }
  if (out.side_px == 0) throw InputError(describe({name, 0, ""}, "another kind of input", allowed));
  return out;
}

}  // namespace observation
}  // namespace walktrack
