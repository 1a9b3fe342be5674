#include "io/ffmpeg/video_decoder.h"

#include <array>
#include <fstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/imgproc.hpp>

#include "core/rng.h"
#include "io/ffmpeg/mean_colours.h"
#include "io/video/video.h"
#include "io/video/video_writer.h"
#include "observation/shrink.h"
#include "tests/io/sample_files.h"
#include "tests/io/sample_video.h"

namespace walktrack {
namespace {

constexpr int kWidth = 200, kHeight = 152;
constexpr double kRounding = 3;  // grey levels

// Smooth, so that compression keeps it, and without colours that YUV does not have.
cv::Mat coloured_frame(int index) {
  cv::Mat frame(kHeight, kWidth, CV_8UC3);
  for (int y = 0; y < frame.rows; ++y)
    for (int x = 0; x < frame.cols; ++x)
      frame.at<cv::Vec3b>(y, x) =
          cv::Vec3b(uchar(60 + x / 2), uchar(70 + y / 2 + 3 * index), uchar(180 - (x + y) / 4));
  return frame;
}

void write_coloured(const std::string& path, int frames) {
  VideoWriter writer(path, {kWidth, kHeight}, 25);
  for (int i = 0; i < frames; ++i) writer.write(coloured_frame(i));
  writer.close();
}

// A video of JPEG images, whose brightness has its full range.
void write_jpegs(const std::string& path, const std::vector<cv::Mat>& frames) {
  std::ofstream file(path, std::ios::binary);
  for (const cv::Mat& frame : frames) {
    std::vector<uchar> bytes;
    cv::imencode(".jpg", frame, bytes);
    file.write(reinterpret_cast<const char*>(bytes.data()), std::ssize(bytes));
  }
}

double largest_difference(const cv::Mat& a, const cv::Mat& b) {
  return cv::norm(a, b, cv::NORM_INF);
}
// Planes of chance, of colours that exist.
struct ChancePlanes {
  explicit ChancePlanes(bool full_range) {
    Rng rng(7, Purpose::kTest);
    for (auto& plane : values) {
      const bool luma = &plane == &values[0];
      plane.resize(luma ? kWidth * kHeight : kWidth / 2 * kHeight / 2);
      for (uint8_t& value : plane)
        value = static_cast<uint8_t>(luma ? 60 + 130 * rng.uniform() : 113 + 30 * rng.uniform());
    }
    planes = {{values[0].data(), values[1].data(), values[2].data()},
              {kWidth, kWidth / 2, kWidth / 2},
              full_range};
  }
  // The colour of one pixel, by the inverse of the definition of BT.601:
  // Y = .299 R + .587 G + .114 B, Cb = (B - Y) / 1.772, Cr = (R - Y) / 1.402.
  cv::Vec3d bgr(int x, int y) const {
    const size_t chroma = static_cast<size_t>(y / 2 * (kWidth / 2) + x / 2);
    double luma = values[0][static_cast<size_t>(y * kWidth + x)];
    double cb = values[1][chroma] - 128.0, cr = values[2][chroma] - 128.0;
    if (!planes.full_range) {
      luma = (luma - 16) * 255 / 219;
      cb *= 255.0 / 224;
      cr *= 255.0 / 224;
    }
    const double blue = luma + 1.772 * cb, red = luma + 1.402 * cr;
    return {blue, (luma - 0.114 * blue - 0.299 * red) / 0.587, red};
  }
  std::array<std::vector<uint8_t>, 3> values;
  ColourPlanes planes;
};

// For any factor and any corner of the area.
TEST(MeanColours, AreThoseOfThePixelsOneByOne) {
  for (const bool full_range : {false, true}) {
    const ChancePlanes chance(full_range);
    for (const int factor : {2, 3, 4, 5, 7, 13})
      for (const cv::Rect& area : {cv::Rect(0, 0, 200, 152), cv::Rect(3, 5, 130, 91),
                                   cv::Rect(8, 2, 104, 52), cv::Rect(7, 6, 13, 13)}) {
        cv::Mat small;
        mean_colours(chance.planes, area, factor, small);
        ASSERT_EQ(small.size(), cv::Size(area.width / factor, area.height / factor));
        for (int y = 0; y < small.rows; ++y)
          for (int x = 0; x < small.cols; ++x) {
            cv::Vec3d sum;
            for (int i = 0; i < factor * factor; ++i)
              sum += chance.bgr(area.x + x * factor + i % factor, area.y + y * factor + i / factor);
            for (int c = 0; c < 3; ++c)
              ASSERT_NEAR(small.at<cv::Vec3b>(y, x)[c], sum[c] / (factor * factor), 0.501)
                  << factor << area << x << " " << y;
          }
      }
  }
}

// FFmpeg's conversion of whole pictures rounds down, by up to two levels.
TEST(VideoDecoder, ShrinksAsConvertedPixelsAreShrunk) {
  const TemporaryFolder folder;
  write_coloured(folder / "v.mp4", 3);
  write_jpegs(folder / "v.mjpeg", {coloured_frame(0), coloured_frame(1)});
  for (const char* name : {"v.mp4", "v.mjpeg"}) {
    const auto decoder = VideoDecoder::open(folder / name);
    ASSERT_TRUE(decoder) << name;
    ASSERT_TRUE(decoder->advance());
    cv::Mat whole, small;
    decoder->picture(whole);
    EXPECT_LT(cv::norm(whole, coloured_frame(0), cv::NORM_L1) / double(whole.total() * 3), 3);
    for (const int factor : {1, 2, 3, 4, 13})
      for (const cv::Rect& area : {cv::Rect(0, 0, 195, 143), cv::Rect(3, 5, 130, 91)}) {
        decoder->picture(area, factor, small);
        const cv::Mat expected = shrunk(whole(area), factor);
        ASSERT_EQ(small.size(), expected.size());
        EXPECT_LE(largest_difference(small, expected), factor < 3 ? 0 : kRounding) << name << area;
        decoder->means_of_pixels(area, factor, small);
        ASSERT_EQ(small.size(), expected.size());
        EXPECT_EQ(largest_difference(small, expected), 0) << name << area << factor;
      }
  }
}

// What was skipped is not seen in what follows.
TEST(VideoDecoder, ConvertsTheFrameItIsAt) {
  const TemporaryFolder folder;
  write_sample_video(folder / "v.mp4", 8);
  FrameSource source(folder / "v.mp4");
  cv::Mat frame;
  ASSERT_TRUE(source.advance());
  ASSERT_TRUE(source.skip(3));
  ASSERT_TRUE(source.advance());
  for (const int factor : {1, 2, 4, 8}) {
    source.picture(factor, frame);
    EXPECT_EQ(frame.size(), cv::Size(64 / factor, 48 / factor));
    EXPECT_EQ(shown_number(frame), 4);
  }
}

// A turned video is cut off and shrunk as the turned picture is.
TEST(FrameSource, ShrinksTurnedFramesAsTheyAreShown) {
  const TemporaryFolder folder;
  const std::string file = folder / "v.mp4";
  for (const int clockwise_deg : {90, 180, 270}) {
    write_coloured(file, 2);
    turn_video(file, clockwise_deg);
    FrameSource source(file);
    EXPECT_EQ(source.facts().rotation_deg, clockwise_deg);
    cv::Mat whole, small;
    ASSERT_TRUE(source.read(whole));
    const bool upright = clockwise_deg == 180;
    ASSERT_EQ(whole.size(), upright ? cv::Size(kWidth, kHeight) : cv::Size(kHeight, kWidth));
    cv::Mat expected;
    cv::rotate(coloured_frame(0), expected,
               clockwise_deg == 90    ? cv::ROTATE_90_CLOCKWISE
               : clockwise_deg == 180 ? cv::ROTATE_180
                                      : cv::ROTATE_90_COUNTERCLOCKWISE);
    EXPECT_LT(cv::norm(whole, expected, cv::NORM_L1) / double(whole.total() * 3), 3);
    for (const int factor : {3, 7, 9}) {
      source.picture(factor, small);
      ASSERT_EQ(small.size(), shrunk(whole, factor).size());
      EXPECT_LE(largest_difference(small, shrunk(whole, factor)), factor < 8 ? 0 : kRounding)
          << clockwise_deg << factor;
      const cv::Rect area(11, 6, 99, 85);
      source.picture(area, factor, small);
      EXPECT_LE(largest_difference(small, shrunk(whole(area), factor)), kRounding)
          << clockwise_deg << factor;
    }
  }
}

TEST(FrameSource, RefusesAVideoThatChangesItsSize) {
  const TemporaryFolder folder;
  const cv::Mat frame = coloured_frame(0);
  write_jpegs(folder / "v.mjpeg", {frame, frame, shrunk(frame, 2)});
  FrameSource source(folder / "v.mjpeg");
  EXPECT_TRUE(source.advance());
  EXPECT_TRUE(source.advance());
  EXPECT_FALSE(source.advance());
  EXPECT_NE(source.trouble().find("frame 2 is 100x76 px, the first 200x152"), std::string::npos)
      << source.trouble();
}

// Its first frames are in the file, and are neither shown nor missing at the end.
TEST(FrameSource, BeginsWhereATrimmedVideoBegins) {
  const TemporaryFolder folder;
  write_sample_video(folder / "v.mp4", 20);
  trim_video(folder / "v.mp4", 6);
  FrameSource source(folder / "v.mp4");
  EXPECT_EQ(source.facts().frame_count, 14);
  cv::Mat frame;
  for (int i = 6; i < 20; ++i) {
    ASSERT_TRUE(source.read(frame)) << i;
    EXPECT_EQ(shown_number(frame), i);
  }
  EXPECT_FALSE(source.advance());
  EXPECT_EQ(source.trouble(), "");
}

TEST(VideoDecoder, OpensNothingThatHasNoVideo) {
  const TemporaryFolder folder;
  EXPECT_FALSE(VideoDecoder::open(folder / "absent.mp4"));
  EXPECT_FALSE(VideoDecoder::open(folder.write("empty.mp4", "")));
  EXPECT_FALSE(VideoDecoder::open(folder.write("text.mp4", "no video at all")));
}

}  // namespace
}  // namespace walktrack
