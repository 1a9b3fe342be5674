// Plain structs as bytes and back, for files that only the program that wrote them reads again.
// Numbers are stored as this machine holds them, lists and texts with their length in front.
//
// A struct takes part by a function that names all of its members, for both directions:
//   template <typename Archive, ArchivedAs<Point> T>
//   void fields(Archive& archive, T& value) {
//     auto& [x, y] = value;
//     archive(x, y);
//   }
// The structured binding makes a member that was added and forgotten an error of the compiler.
#pragma once

#include <array>
#include <concepts>
#include <cstdint>
#include <cstring>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "core/errors.h"

namespace walktrack {

template <typename T, typename Struct>
concept ArchivedAs = std::same_as<std::remove_const_t<T>, Struct>;

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

// Reads what a writer wrote, in the same order. InputError, naming the file, where the bytes end
// before what they announce.
class ArchiveReader {
 public:
  // Both have to outlive the reader.
  ArchiveReader(std::string_view bytes, std::string_view file) : rest_(bytes), file_(file) {}

  template <typename... T>
  void operator()(T&... values) {
    (get(values), ...);
  }
  bool at_end() const { return rest_.empty(); }

 private:
  void raw(void* data, size_t size) {
    if (size > rest_.size()) ends_early();
    if (size > 0) std::memcpy(data, rest_.data(), size);
    rest_.remove_prefix(size);
  }
  [[noreturn]] void ends_early() const {
    throw InputError(std::string(file_) + ": ends before what it announces");
  }
  // A length, which no element can undercut by taking less than `least` bytes.
  size_t length(size_t least) {
    uint64_t count = 0;
    get(count);
    if (count > rest_.size() / least) ends_early();
    return static_cast<size_t>(count);
  }

  template <typename T>
  void get(T& value) {
    if constexpr (std::is_arithmetic_v<T> || std::is_enum_v<T>) {
      raw(&value, sizeof value);
    } else {
      fields(*this, value);
    }
  }
  void get(bool& value) {
    uint8_t byte = 0;
    get(byte);
    value = byte != 0;
  }
  template <typename T, int Rows, int Columns>
  void get(Eigen::Matrix<T, Rows, Columns>& value) {
    raw(value.data(), sizeof(T) * static_cast<size_t>(value.size()));
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
    if constexpr (std::is_arithmetic_v<T>) {
      values.resize(length(sizeof(T)));
      raw(values.data(), sizeof(T) * values.size());
    } else {
      values.resize(length(1));
      for (T& value : values) get(value);
    }
  }
  template <typename T>
  void get(std::deque<T>& values) {
    values.resize(length(1));
    for (T& value : values) get(value);
  }
  void get(std::string& text) {
    text.resize(length(1));
    raw(text.data(), text.size());
  }

  std::string_view rest_, file_;
};

}  // namespace walktrack
