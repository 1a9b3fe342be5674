#include "io/archive/archive.h"

#include <gtest/gtest.h>

namespace walktrack {
namespace {

enum class Colour : uint8_t { kRed = 3 };

struct Inner {
  double x = 0;
  Eigen::Vector2d place = Eigen::Vector2d::Zero();
  bool operator==(const Inner&) const = default;
};

struct Everything {
  bool yes = false;
  Colour colour{};
  std::string text;
  std::array<Inner, 2> pair;
  std::vector<float> numbers;
  std::deque<double> queue;
  std::vector<Inner> list;
  std::optional<Inner> some, none;
  std::vector<std::pair<std::string, std::string>> words;
  bool operator==(const Everything&) const = default;
};

template <typename Archive, ArchivedAs<Inner> T>
void fields(Archive& archive, T& value) {
  auto& [x, place] = value;
  archive(x, place);
}

template <typename Archive, ArchivedAs<Everything> T>
void fields(Archive& archive, T& value) {
  auto& [yes, colour, text, pair, numbers, queue, list, some, none, words] = value;
  archive(yes, colour, text, pair, numbers, queue, list, some, none, words);
}

Everything full() {
  const Inner inner{0.1, {1, -2}};
  return {true,
          Colour::kRed,
          std::string("a\0b", 3),
          {inner, Inner{}},
          {1.5f, -0.0f},
          {3, 4},
          {inner, inner},
          inner,
          {},
          {{"k", "v"}}};
}

TEST(Archive, WhatWasWrittenComesBack) {
  ArchiveWriter writer;
  writer(full(), int64_t{-7});
  ArchiveReader reader(writer.bytes(), "a.bin");
  Everything found;
  found.none = Inner{};  // what the reader finds there before does not stay
  int64_t number = 0;
  reader(found, number);
  EXPECT_EQ(found, full());
  EXPECT_EQ(number, -7);
  EXPECT_TRUE(reader.at_end());
}

TEST(Archive, BytesThatEndEarlyAreAnErrorWhereverTheyEnd) {
  ArchiveWriter writer;
  writer(full());
  for (size_t size = 0; size < writer.bytes().size(); ++size) {
    ArchiveReader reader(std::string_view(writer.bytes()).substr(0, size), "a.bin");
    Everything found;
    EXPECT_THROW(reader(found), InputError) << size;
  }
}

TEST(Archive, ALengthBeyondTheBytesTakesNoMemory) {
  ArchiveWriter writer;
  writer(~uint64_t{0});
  ArchiveReader reader(writer.bytes(), "a.bin");
  std::vector<Inner> list;
  EXPECT_THROW(reader(list), InputError);
}

}  // namespace
}  // namespace walktrack
