// Converts plain structs to bytes and back, for files that are only read by the program that wrote
// them. Numbers are stored in the machine's representation; lists and texts follow their length.
//
// A file may be damaged or forged, so the reader checks everything: a flag is 0 or 1, an enum is
// one of its values, a number is finite unless its field says any_number(), a number that is used
// as a count or an index is within(its bounds), a list is no longer than the remaining bytes allow.
// For an enum, last_value(E) states its largest value; the smallest is 0.
//
// A struct is archived by a function that names all of its members, for both directions:
//   template <typename Archive, ArchivedAs<Point> T>
//   void fields(Archive& archive, T& value) {
//     auto& [x, y] = value;
//     archive(x, y);
//   }
// Because of the structured binding, a member that was added and forgotten is a compile error.
#pragma once

#include <array>
#include <cmath>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <deque>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/errors.h"

namespace walktrack {
inline namespace io {

template <typename T, typename Struct>
concept ArchivedAs = std::same_as<std::remove_const_t<T>, Struct>;

// A field whose numbers may have any value: NaN stands for unknown, infinities for impossible.
template <typename T>
struct AnyNumber {
  T& value;
};
template <typename T>
AnyNumber<T> any_number(T& value) {
  return {value};
}

// A number from `least` to `most`.
template <typename T>
struct Within {
  T& value;
  std::remove_const_t<T> least, most;
};
template <typename T>
Within<T> within(T& value, std::type_identity_t<std::remove_const_t<T>> least,
                 std::type_identity_t<std::remove_const_t<T>> most) {
  return {value, least, most};
}

class ArchiveWriter {
 public:
  template <typename... T>
  void operator()(const T&... values) {
    (put(values), ...);
  }
  const std::string& bytes() const { return bytes_; }

 private:
  void raw(const void* data, size_t size) { bytes_.append(static_cast<const char*>(data), size); }

  template <typename T>
  void put(const T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      raw(&value, sizeof value);
    } else {
      fields(*this, value);
    }
  }
  template <typename T>
  void put(const AnyNumber<T>& field) {
    put(field.value);
  }
  template <typename T>
  void put(const Within<T>& field) {
    put(field.value);
  }
  template <typename T, int Rows, int Columns>
  void put(const Eigen::Matrix<T, Rows, Columns>& value) {
    raw(value.data(), sizeof(T) * static_cast<size_t>(value.size()));
  }
  template <typename T, size_t N>
  void put(const std::array<T, N>& values) {
    for (const T& value : values) put(value);
  }
  template <typename First, typename Second>
  void put(const std::pair<First, Second>& value) {
    (*this)(value.first, value.second);
  }
  template <typename T>
  void put(const std::optional<T>& value) {
    put(value.has_value());
    if (value) put(*value);
  }
  template <typename T>
  void put(const std::vector<T>& values) {
    put(uint64_t{values.size()});
    if constexpr (std::is_arithmetic_v<T>) {
      raw(values.data(), sizeof(T) * values.size());
    } else {
      for (const T& value : values) put(value);
    }
  }
  template <typename T>
  void put(const std::deque<T>& values) {
    put(uint64_t{values.size()});
    for (const T& value : values) put(value);
  }
  void put(const std::string& text) {
    put(uint64_t{text.size()});
    raw(text.data(), text.size());
  }

  std::string bytes_;
};

// The least number of bytes of a T: those of one whose lists and optional members are empty.
template <typename T>
size_t least_bytes() {
  static const size_t bytes = [] {
    ArchiveWriter writer;
    writer(T{});
    return writer.bytes().size();
  }();
  return bytes;
}

// Reads what a writer wrote, in the same order. Throws an InputError that names the file if the
// bytes end too early or contain something that no writer writes.
class ArchiveReader {
 public:
  // Both have to outlive the reader.
  ArchiveReader(std::string_view bytes, std::string_view file) : rest_(bytes), file_(file) {}

  template <typename... T>
  void operator()(T&&... values) {
    (get(values), ...);
  }
  bool at_end() const { return rest_.empty(); }
  // Throws an InputError for content that is inconsistent.
  [[noreturn]] void fail(std::string_view what) const {
    throw InputError(std::string(file_) + ": is damaged: " + std::string(what));
  }

 private:
  void raw(void* data, size_t size) {
    if (size > rest_.size()) ends_early();
    if (size > 0) std::memcpy(data, rest_.data(), size);
    rest_.remove_prefix(size);
  }
  [[noreturn]] void ends_early() const {
    throw InputError(std::string(file_) + ": ends before what it announces");
  }
  // Reads the length of a list whose elements take at least so many bytes each.
  size_t length(size_t least) {
    uint64_t count = 0;
    get(count);
    if (count > rest_.size() / least) ends_early();
    return static_cast<size_t>(count);
  }
  template <typename T>
  void numbers(std::span<T> values) {
    raw(values.data(), values.size_bytes());
    if constexpr (std::is_floating_point_v<T>) {
      for (const T value : values)
        if (!any_number_ && !std::isfinite(value)) fail("a number that is not finite");
    }
  }

  template <typename T>
  void get(T& value) {
    if constexpr (std::is_enum_v<T>) {
      std::underlying_type_t<T> number{};
      get(number);
      if (std::cmp_less(number, 0) || value_of(last_value(T{})) < number) fail("an unknown value");
      value = static_cast<T>(number);
    } else if constexpr (std::is_arithmetic_v<T>) {
      numbers(std::span(&value, 1));
    } else {
      fields(*this, value);
    }
  }
  template <typename T>
  static auto value_of(T value) {
    return static_cast<std::underlying_type_t<T>>(value);
  }
  void get(bool& value) {
    uint8_t byte = 0;
    get(byte);
    if (byte > 1) fail("a flag that is neither set nor not");
    value = byte != 0;
  }
  template <typename T>
  void get(AnyNumber<T>& field) {
    const bool before = std::exchange(any_number_, true);
    get(field.value);
    any_number_ = before;
  }
  template <typename T>
  void get(Within<T>& field) {
    get(field.value);
    if (field.value < field.least || field.most < field.value) fail("a number out of its bounds");
  }
  template <typename T, int Rows, int Columns>
  void get(Eigen::Matrix<T, Rows, Columns>& value) {
    numbers(std::span(value.data(), static_cast<size_t>(value.size())));
  }
  template <typename T, size_t N>
  void get(std::array<T, N>& values) {
    for (T& value : values) get(value);
  }
  template <typename First, typename Second>
  void get(std::pair<First, Second>& value) {
    (*this)(value.first, value.second);
  }
  template <typename T>
  void get(std::optional<T>& value) {
    bool there = false;
    get(there);
    value.reset();
    if (there) get(value.emplace());
  }
  template <typename T>
  void get(std::vector<T>& values) {
    values.resize(length(least_bytes<T>()));
    if constexpr (std::is_arithmetic_v<T>) {
      numbers(std::span(values));
    } else {
      for (T& value : values) get(value);
    }
  }
  template <typename T>
  void get(std::deque<T>& values) {
    values.resize(length(least_bytes<T>()));
    for (T& value : values) get(value);
  }
  void get(std::string& text) {
    text.resize(length(1));
    raw(text.data(), text.size());
  }

  std::string_view rest_, file_;
  bool any_number_ = false;
};

}  // namespace io
}  // namespace walktrack
