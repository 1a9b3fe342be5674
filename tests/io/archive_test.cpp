#include "io/archive/archive.h"

#include <cmath>

#include <gtest/gtest.h>

namespace walktrack {
namespace {

enum class Colour : uint8_t { kRed = 3 };
constexpr Colour last_value(Colour) { return Colour::kRed; }

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
  found.none = Inner{};  // the former value is replaced
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

// Writes a value as A and reads its bytes as B.
template <typename Written, typename Read>
Read read_as(const Written& written) {
  ArchiveWriter writer;
  writer(written);
  ArchiveReader reader(writer.bytes(), "a.bin");
  Read value{};
  reader(value);
  return value;
}

TEST(Archive, AByteThatIsNoValueOfAnEnumOrAFlagIsAnError) {
  EXPECT_EQ((read_as<uint8_t, Colour>(3)), Colour::kRed);
  EXPECT_THROW((read_as<uint8_t, Colour>(4)), InputError);
  EXPECT_THROW((read_as<uint8_t, Colour>(255)), InputError);
  EXPECT_TRUE((read_as<uint8_t, bool>(1)));
  EXPECT_THROW((read_as<uint8_t, bool>(2)), InputError);
}

TEST(Archive, NumbersAreFiniteUnlessTheirFieldSaysAnything) {
  for (const double odd : {std::nan(""), HUGE_VAL, -HUGE_VAL}) {
    EXPECT_THROW((read_as<double, double>(odd)), InputError);
    EXPECT_THROW((read_as<std::vector<double>, std::vector<double>>({1, odd})), InputError);
    EXPECT_THROW((read_as<Inner, Inner>({1, {0, odd}})), InputError);
    ArchiveWriter writer;
    writer(odd, odd);
    ArchiveReader reader(writer.bytes(), "a.bin");
    double first = 0, second = 0;
    reader(any_number(first));
    EXPECT_FALSE(std::isfinite(first));
    EXPECT_THROW(reader(second), InputError) << "the next field is finite again";
  }
}

TEST(Archive, NumbersWithBoundsKeepThem) {
  for (const int number : {-1, 0, 17, 18}) {
    ArchiveWriter writer;
    writer(number);
    ArchiveReader reader(writer.bytes(), "a.bin");
    int found = 0;
    const bool inside = number >= 0 && number <= 17;
    if (inside) {
      reader(within(found, 0, 17));
      EXPECT_EQ(found, number);
    } else {
      EXPECT_THROW(reader(within(found, 0, 17)), InputError);
    }
  }
}

struct Wide {
  std::array<Inner, 40> inner;
};
template <typename Archive, ArchivedAs<Wide> T>
void fields(Archive& archive, T& value) {
  auto& [inner] = value;
  archive(inner);
}

// 1,000 bytes cannot contain 1,000 elements of 960: the list is refused before memory is allocated.
TEST(Archive, AListIsNoLongerThanTheBytesCanHold) {
  EXPECT_EQ(least_bytes<Wide>(), 960u);
  ArchiveWriter writer;
  writer(uint64_t{1000}, std::string(992, 'a'));
  ArchiveReader reader(writer.bytes(), "a.bin");
  std::vector<Wide> list;
  EXPECT_THROW(reader(list), InputError);
  EXPECT_EQ(list.capacity(), 0u);
}

}  // namespace
}  // namespace walktrack
