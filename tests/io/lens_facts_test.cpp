#include "io/video/lens_facts.h"

#include <gtest/gtest.h>

#include "tests/run_program.h"

namespace walktrack {
namespace {

std::string number(unsigned value, size_t bytes, bool big) {
  std::string out;
  for (size_t i = 0; i < bytes; ++i)
    out += static_cast<char>(value >> 8 * (big ? bytes - 1 - i : i) & 255);
  return out;
}

// One field of a TIFF directory.
std::string field(unsigned tag, unsigned type, unsigned value, size_t bytes, bool big) {
  return number(tag, 2, big) + number(type, 2, big) + number(1, 4, big) +
         number(value, bytes, big) + std::string(4 - bytes, '\0');
}

std::string jpeg(unsigned focal_mm, bool big) {
  const auto n = [&](unsigned value, size_t bytes) { return number(value, bytes, big); };
  // Header of 8 bytes, a directory of two fields (2 + 24 + 4), EXIF's of two.
  std::string tiff = (big ? "MM" : "II") + n(42, 2) + n(8, 4);
  tiff += n(2, 2) + field(0x0112, 3, 1, 2, big) + field(0x8769, 4, 38, 4, big) + n(0, 4);
  tiff += n(2, 2) + field(0x9207, 3, 5, 2, big) + field(0xA405, 3, focal_mm, 2, big) + n(0, 4);
  const std::string exif = std::string("Exif\0\0", 6) + tiff;
  const auto segment = [](unsigned kind, const std::string& content) {
    return number(kind, 2, true) + number(static_cast<unsigned>(content.size() + 2), 2, true) +
           content;
  };
  return number(0xFFD8, 2, true) + segment(0xFFE0, "JFIF") + segment(0xFFE1, exif) +
         number(0xFFDA, 2, true);
}

TEST(ExifFocalLength, IsReadInEitherByteOrder) {
  EXPECT_EQ(exif_focal_length_35mm(jpeg(26, true)), 26);
  EXPECT_EQ(exif_focal_length_35mm(jpeg(28, false)), 28);
}

TEST(ExifFocalLength, OfWhatDoesNotSayIsNothing) {
  EXPECT_FALSE(exif_focal_length_35mm(jpeg(0, true)));  // "unknown" by the standard
  EXPECT_FALSE(exif_focal_length_35mm("no picture"));
  EXPECT_FALSE(exif_focal_length_35mm(""));
  std::string whole = jpeg(26, true);
  for (size_t length = 0; length < whole.size(); ++length)
    exif_focal_length_35mm(whole.substr(0, length));  // reads nothing beyond the end
  EXPECT_FALSE(exif_focal_length_35mm(whole.substr(0, whole.size() - 20)));
}

TEST(FocalLength, OfAFolderIsThatOfItsFirstImage) {
  const TemporaryFolder place;
  place.write("frames/1.jpg", jpeg(35, true));
  place.write("frames/2.jpg", jpeg(50, true));
  EXPECT_EQ(focal_length_35mm(place / "frames"), 35);
  EXPECT_FALSE(focal_length_35mm(place / "nowhere.mp4"));
  EXPECT_FALSE(
      focal_length_35mm(std::filesystem::path(WALKTRACK_SOURCE_DIR) / "data/demo/side.mp4"));
}

}  // namespace
}  // namespace walktrack
