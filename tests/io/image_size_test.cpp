// Compared with OpenCV's decoders: the header states the decoded size.
#include "io/video/image_size.h"

#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "io/video/image_files.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

std::span<const unsigned char> bytes_of(const std::string& text) {
  return {reinterpret_cast<const unsigned char*>(text.data()), text.size()};
}

TEST(ImageSize, IsWhatTheDecodersFind) {
  const cv::Mat image(37, 300, CV_8UC3, cv::Scalar(40, 90, 200));
  for (const char* format : {".png", ".jpg", ".bmp", ".tif", ".ppm", ".webp"}) {
    std::vector<unsigned char> coded;
    ASSERT_TRUE(cv::imencode(format, image, coded)) << format;
    const auto size = image_size_from_header(coded);
    ASSERT_TRUE(size) << format;
    EXPECT_EQ(size->width, 300) << format;
    EXPECT_EQ(size->height, 37) << format;
  }
  std::vector<unsigned char> lossless;
  cv::imencode(".webp", image, lossless, {cv::IMWRITE_WEBP_QUALITY, 101});
  ASSERT_TRUE(image_size_from_header(lossless));
  EXPECT_EQ(image_size_from_header(lossless)->width, 300);
}

TEST(ImageSize, IsUnknownForWhatIsCutOff) {
  const cv::Mat image(5, 7, CV_8UC3, cv::Scalar(40, 90, 200));
  for (const char* format : {".png", ".jpg", ".bmp", ".tif", ".ppm", ".webp"}) {
    std::vector<unsigned char> coded;
    cv::imencode(format, image, coded);
    for (size_t length = 0; length < coded.size(); ++length) {
      // A header is complete or unknown; a PNM's number may be truncated to a smaller one.
      const auto size = image_size_from_header({coded.data(), length});
      if (size) {
        EXPECT_LE(size->width, 7) << format << " " << length;
      }
    }
    EXPECT_FALSE(image_size_from_header({coded.data(), 3})) << format;
  }
  EXPECT_FALSE(image_size_from_header(bytes_of("this is no image")));
  EXPECT_FALSE(image_size_from_header(bytes_of("P5 0 5 255\n")));
}

// A few bytes that state a size of 30 gigabytes are refused before anything is decoded.
TEST(ReadImageFile, RefusesSizesThatNobodyFilms) {
  const TemporaryFolder folder;
  const std::string file = folder.write("bomb.png", "P6 100000 100000 255\n");
  cv::Mat image;
  EXPECT_EQ(read_image_file(file, image), "100000x100000 px, up to 8192 px are allowed");
}

}  // namespace
}  // namespace walktrack
