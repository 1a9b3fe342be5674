#include "io/video/image_size.h"

#include <algorithm>
#include <cctype>
#include <string_view>

namespace walktrack {
inline namespace io {

namespace {

using Bytes = std::span<const unsigned char>;
using Size = std::optional<StatedSize>;

enum class Order { kLittle, kBig };

bool begins_with(Bytes bytes, std::string_view text, size_t at = 0) {
  return bytes.size() >= at + text.size() &&
         std::equal(
             text.begin(), text.end(), bytes.begin() + static_cast<std::ptrdiff_t>(at),
             [](char c, unsigned char byte) { return static_cast<unsigned char>(c) == byte; });
}

// An unsigned number of `count` bytes; nullopt past the end.
std::optional<int64_t> number_at(Bytes bytes, size_t at, size_t count, Order order) {
  if (at > bytes.size() || count > bytes.size() - at) return std::nullopt;
  int64_t value = 0;
  for (size_t i = 0; i < count; ++i) {
    const size_t from_top = order == Order::kBig ? i : count - 1 - i;
    value = value << 8 | bytes[at + from_top];
  }
  return value;
}

Size size_of(std::optional<int64_t> width, std::optional<int64_t> height) {
  if (!width || !height || *width < 1 || *height < 1) return std::nullopt;
  return StatedSize{*width, *height};
}

// Two numbers of `count` bytes, `step` bytes apart.
Size size_at(Bytes bytes, size_t at, size_t count, Order order) {
  return size_of(number_at(bytes, at, count, order), number_at(bytes, at + count, count, order));
}

// ISO/IEC 15948: the first chunk is IHDR.
Size png_size(Bytes bytes) {
  return begins_with(bytes, "IHDR", 12) ? size_at(bytes, 16, 4, Order::kBig) : std::nullopt;
}

// BITMAPCOREHEADER has 12 bytes and 16-bit numbers; later headers have signed 32-bit numbers, and a
// negative height for rows that are stored from the top.
Size bmp_size(Bytes bytes) {
  if (number_at(bytes, 14, 4, Order::kLittle) == 12) return size_at(bytes, 18, 2, Order::kLittle);
  const Size size = size_at(bytes, 18, 4, Order::kLittle);
  if (!size || size->width > INT32_MAX) return std::nullopt;
  const int64_t height = size->height;
  return StatedSize{size->width, height > INT32_MAX ? (int64_t{1} << 32) - height : height};
}

// "P5 640 480 255", with white space and comments between the words.
Size pnm_size(Bytes bytes) {
  size_t at = 2;
  const auto number = [&]() -> std::optional<int64_t> {
    while (at < bytes.size() && (std::isspace(bytes[at]) || bytes[at] == '#')) {
      if (bytes[at] == '#') {
        while (at < bytes.size() && bytes[at] != '\n') ++at;
      } else {
        ++at;
      }
    }
    std::optional<int64_t> value;
    for (; at < bytes.size() && std::isdigit(bytes[at]); ++at) {
      value = std::min<int64_t>(value.value_or(0) * 10 + (bytes[at] - '0'), UINT32_MAX);
    }
    return value;
  };
  const auto width = number();
  return size_of(width, number());
}

// RFC 9649: a lossy, lossless or extended first chunk.
Size webp_size(Bytes bytes) {
  if (begins_with(bytes, "VP8 ", 12)) {
    const Size size = size_at(bytes, 26, 2, Order::kLittle);
    return size ? size_of(size->width & 0x3fff, size->height & 0x3fff) : std::nullopt;
  }
  if (begins_with(bytes, "VP8L", 12)) {
    const auto bits = number_at(bytes, 21, 4, Order::kLittle);
    if (!bits) return std::nullopt;
    return StatedSize{1 + (*bits & 0x3fff), 1 + (*bits >> 14 & 0x3fff)};
  }
  if (!begins_with(bytes, "VP8X", 12)) return std::nullopt;
  const auto width = number_at(bytes, 24, 3, Order::kLittle);
  const auto height = number_at(bytes, 27, 3, Order::kLittle);
  return width && height ? Size(StatedSize{1 + *width, 1 + *height}) : std::nullopt;
}

// TIFF 6.0: entries of 12 bytes in the first directory; tags 256 and 257, types SHORT and LONG.
Size tiff_size(Bytes bytes, Order order) {
  const auto directory = number_at(bytes, 4, 4, order);
  if (!directory) return std::nullopt;
  const auto start = static_cast<size_t>(*directory);
  const auto entries = number_at(bytes, start, 2, order);
  std::optional<int64_t> width, height;
  for (size_t i = 0; entries && i < static_cast<size_t>(*entries); ++i) {
    const size_t entry = start + 2 + 12 * i;
    const auto tag = number_at(bytes, entry, 2, order);
    if (!tag) break;
    const auto type = number_at(bytes, entry + 2, 2, order);
    const auto value = number_at(bytes, entry + 8, type == 3 ? 2 : 4, order);
    if (*tag == 256) width = value;
    if (*tag == 257) height = value;
  }
  return size_of(width, height);
}

// ITU T.81: segments from marker to marker; the frame header (SOFn) has height, then width.
Size jpeg_size(Bytes bytes) {
  size_t at = 2;
  while (at + 1 < bytes.size()) {
    if (bytes[at] != 0xff || bytes[at + 1] == 0xff || bytes[at + 1] == 0) {
      ++at;  // fill bytes and data that decoders skip
      continue;
    }
    const unsigned char marker = bytes[at + 1];
    const bool is_frame =
        marker >= 0xc0 && marker <= 0xcf && marker != 0xc4 && marker != 0xc8 && marker != 0xcc;
    if (is_frame) {
      return size_of(number_at(bytes, at + 7, 2, Order::kBig),
                     number_at(bytes, at + 5, 2, Order::kBig));
    }
    const bool is_bare = marker == 0x01 || (marker >= 0xd0 && marker <= 0xd9);
    const auto length = is_bare ? 0 : number_at(bytes, at + 2, 2, Order::kBig);
    if (!length) return std::nullopt;
    at += 2 + static_cast<size_t>(*length);
  }
  return std::nullopt;
}

}  // namespace

std::optional<StatedSize> image_size_from_header(Bytes bytes) {
  if (begins_with(bytes, "\x89PNG\r\n\x1a\n")) return png_size(bytes);
  if (begins_with(bytes, "\xff\xd8\xff")) return jpeg_size(bytes);
  if (begins_with(bytes, "BM")) return bmp_size(bytes);
  if (begins_with(bytes, {"II*\0", 4})) return tiff_size(bytes, Order::kLittle);
  if (begins_with(bytes, {"MM\0*", 4})) return tiff_size(bytes, Order::kBig);
  if (begins_with(bytes, "RIFF") && begins_with(bytes, "WEBP", 8)) return webp_size(bytes);
  const bool is_pnm = bytes.size() > 2 && bytes[0] == 'P' && bytes[1] >= '1' && bytes[1] <= '6';
  return is_pnm ? pnm_size(bytes) : std::nullopt;
}

}  // namespace io
}  // namespace walktrack
