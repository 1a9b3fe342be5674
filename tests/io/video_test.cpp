#include "io/video/video.h"

#include <sched.h>

#include <algorithm>
#include <fstream>
#include <set>
#include <vector>

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "core/errors.h"
#include "io/video/image_files.h"
#include "io/video/video_writer.h"
#include "tests/io/sample_files.h"
#include "tests/io/sample_video.h"
#include "tests/sanitized.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST(NaturalLess, ComparesNumbersByValue) {
  EXPECT_TRUE(natural_less("frame2", "frame10"));
  EXPECT_FALSE(natural_less("frame10", "frame2"));
  EXPECT_TRUE(natural_less("a1b2", "a1b10"));
  EXPECT_TRUE(natural_less("a", "b"));
  EXPECT_TRUE(natural_less("a", "a1"));
  EXPECT_TRUE(natural_less("007", "8"));
  EXPECT_FALSE(natural_less("x", "x"));
  EXPECT_NE(natural_less("a01", "a1"), natural_less("a1", "a01"));  // an order, not a tie
}

TEST(FrameSource, ReadsAVideoFrameByFrame) {
  const TemporaryFolder folder;
  write_sample_video(folder / "v.mp4", 12);
  FrameSource source(folder / "v.mp4");
  EXPECT_EQ(source.facts().width_px, 64);
  EXPECT_EQ(source.facts().height_px, 48);
  EXPECT_EQ(source.facts().frame_count, 12);
  EXPECT_EQ(source.facts().frame_rate, 25);
  cv::Mat frame;
  for (int i = 0; i < 12; ++i) {
    ASSERT_TRUE(source.read(frame));
    EXPECT_EQ(shown_number(frame), i);
  }
  EXPECT_FALSE(source.read(frame));
  EXPECT_EQ(source.trouble(), "");
}

TEST(FrameSource, SkipsToTheExactFrame) {
  const TemporaryFolder folder;
  write_sample_video(folder / "v.mp4", 12);
  write_sample_images(folder / "frames", {0, 1, 2, 3, 4, 5, 6, 7, 8});
  for (const char* name : {"v.mp4", "frames"}) {
    FrameSource source(folder / name);
    cv::Mat frame;
    ASSERT_TRUE(source.skip(7));
    EXPECT_EQ(source.next_frame(), 7);
    ASSERT_TRUE(source.read(frame));
    EXPECT_EQ(shown_number(frame), 7);
    EXPECT_FALSE(source.skip(100));
  }
}

TEST(FrameSource, ReadsFoldersInNaturalOrderAndPatternsByNumber) {
  const TemporaryFolder folder;
  write_sample_images(folder / "f", {9, 10, 11});
  folder.write("f/notes.txt", "no image");
  for (const std::string& name : {folder / "f", folder / "f/frame%d.png"}) {
    FrameSource source(name);
    EXPECT_EQ(source.facts().frame_count, 3);
    EXPECT_EQ(source.facts().frame_rate, 0);
    cv::Mat frame;
    for (const int number : {9, 10, 11}) {
      ASSERT_TRUE(source.read(frame)) << name;
      EXPECT_EQ(shown_number(frame), number);
    }
    EXPECT_FALSE(source.read(frame));
    EXPECT_EQ(source.trouble(), "");
  }
}

TEST(FrameSource, NumbersThatAreLeftOutInAFolderAreDroppedFrames) {
  const TemporaryFolder folder;
  write_sample_images(folder / "f", {9, 10, 13, 14});
  FrameSource source(folder / "f");
  EXPECT_EQ(source.facts().missing, 2);
  EXPECT_EQ(source.facts().frame_count, 6);
  EXPECT_EQ(source.missing_images(), (std::vector<int>{0, 0, 2, 0}));
}

TEST(MissingBefore, IsWhatTheNamesSay) {
  const auto of = [](std::vector<fs::path> names) { return missing_before(names); };
  using Missing = std::vector<int>;
  EXPECT_EQ(of({"a2.png", "a3.png", "a5.png"}), (Missing{0, 0, 1}));
  EXPECT_EQ(of({"a0.png", "a10.png", "a40.png"}), (Missing{0, 0, 2})) << "every tenth";
  EXPECT_EQ(of({"v1/a1.png", "v1/a2.png", "v1/a4.png"}), (Missing{0, 0, 1}));
  EXPECT_EQ(of({"cam2_1.png", "cam2_2.png", "cam2_4.png"}), (Missing{0, 0, 1}));
  EXPECT_EQ(of({"a1.png", "b2.png", "b9.png"}), (Missing{0, 0, 0})) << "names differ otherwise";
  EXPECT_EQ(of({"a1.png", "a01.png", "a3.png"}), (Missing{0, 0, 0})) << "one number twice";
  EXPECT_EQ(of({"t1000.png", "t1033.png", "t1067.png"}), (Missing{0, 0, 0})) << "stamps";
  EXPECT_EQ(of({"a1.png", "a2.png", "a900.png"}), (Missing{0, 0, 0})) << "more than there are";
  EXPECT_EQ(of({"one.png"}), Missing{0});
}

// An image with an invalid colour profile, about which libpng warns for every frame.
TEST(ImageFiles, DecodersDoNotWriteToTheTerminal) {
  const TemporaryFolder folder;
  write_sample_images(folder / "frames", {3});
  std::string png = read_file(folder / "frames/frame3.png");
  constexpr size_t kAfterHeader = 8 + 25;
  const std::string profile("\0\0\0\5iCCPbad\0\0\xe7\0\x56\xfb", 17);  // with its checksum
  png.insert(kAfterHeader, profile);
  const std::string file = folder.write("odd.png", png);
  cv::Mat image;
  testing::internal::CaptureStderr();
  EXPECT_EQ(read_image_file(file, image), "");
  std::fputs("ours\n", stderr);
  const std::string said = testing::internal::GetCapturedStderr();
  // Sanitizers report to the terminal, so that it is not silenced for them.
  EXPECT_THAT(said, testing::EndsWith("ours\n"));
  if (!kSanitized) {
    EXPECT_EQ(said, "ours\n");
  }
  EXPECT_EQ(shown_number(image), 3);
}

// Its lower half would be grey.
TEST(ImageFiles, AJpegThatBreaksOffIsNoImage) {
  const TemporaryFolder folder;
  cv::Mat image = sample_frame(9);
  cv::imwrite(folder / "whole.jpg", image);
  EXPECT_EQ(read_image_file(folder / "whole.jpg", image), "");
  const std::string whole = read_file(folder / "whole.jpg");
  const std::string half = folder.write("half.jpg", whole.substr(0, whole.size() - 20));
  EXPECT_EQ(read_image_file(half, image), "a JPEG that breaks off before its end");
}

TEST(FrameSource, ReadsASingleImage) {
  const TemporaryFolder folder;
  write_sample_images(folder / "f", {5});
  FrameSource source(folder / "f/frame5.png");
  cv::Mat frame;
  EXPECT_TRUE(source.read(frame));
  EXPECT_FALSE(source.read(frame));
}

std::string message_for(const fs::path& path, std::optional<cv::Size> size = std::nullopt) {
  try {
    FrameSource source(path, size);
  } catch (const InputError& error) {
    return error.what();
  }
  return "no InputError";
}

TEST(FrameSource, SaysWhatItCannotRead) {
  const TemporaryFolder folder;
  write_sample_images(folder / "gap", {1, 2, 4});
  write_sample_video(folder / "v.mp4", 2);
  folder.write("text.mp4", "this is no video");
  folder.write("text.png", "this is no image");
  folder.write("empty.mp4", "");
  fs::create_directory(folder / "none");
  EXPECT_THAT(message_for(folder / "missing.mp4"), HasSubstr("missing.mp4: found no file"));
  EXPECT_THAT(message_for(folder / "text.mp4"), HasSubstr("no video that FFmpeg can decode"));
  EXPECT_THAT(message_for(folder / "empty.mp4"), HasSubstr("no video that FFmpeg can decode"));
  EXPECT_THAT(message_for(folder / "text.png"), HasSubstr("text.png: found no PNG, JPEG"));
  EXPECT_THAT(message_for(folder / "none"), HasSubstr("none: found no image"));
  EXPECT_THAT(message_for(folder / "gap/frame%d.png"), HasSubstr("frame 3 missing before 4"));
  EXPECT_THAT(message_for(folder / "gap/frame%s.png"), HasSubstr("a pattern of another kind"));
  EXPECT_THAT(message_for(folder / "gap/other%d.png"), HasSubstr("no file of this pattern"));
  EXPECT_THAT(message_for(folder / "v.mp4", cv::Size(65, 48)),
              HasSubstr("v.mp4: found 64x48 px, allowed: 65x48 px"));
  EXPECT_THAT(message_for(folder / "v.mp4", cv::Size(48, 64)), HasSubstr("are swapped"));
}

TEST(FrameSource, NamesTheFrameThatBreaks) {
  const TemporaryFolder folder;
  write_sample_images(folder / "f", {0, 1, 2});
  folder.write("f/frame1.png", "broken");
  FrameSource source(folder / "f");
  cv::Mat frame;
  EXPECT_TRUE(source.read(frame));
  EXPECT_FALSE(source.read(frame));
  EXPECT_THAT(source.trouble(), HasSubstr("frame1.png: frame 1: no PNG, JPEG"));
  EXPECT_FALSE(source.read(frame));
}

TEST(FrameSource, RefusesAFrameOfAnotherSize) {
  const TemporaryFolder folder;
  write_sample_images(folder / "f", {0, 1});
  cv::imwrite(folder / "f/frame1.png", cv::Mat(10, 10, CV_8UC3, cv::Scalar::all(0)));
  FrameSource source(folder / "f");
  cv::Mat frame;
  EXPECT_TRUE(source.read(frame));
  EXPECT_FALSE(source.read(frame));
  EXPECT_THAT(source.trouble(), HasSubstr("frame 1 is 10x10 px, the first 64x48"));
}

TEST(FrameSource, NoticesATruncatedVideo) {
  const TemporaryFolder folder;
  const std::string file = folder / "v.avi";
  {
    cv::VideoWriter writer(file, cv::CAP_FFMPEG, cv::VideoWriter::fourcc('M', 'J', 'P', 'G'), 25,
                           {64, 48});
    for (int i = 0; i < 40; ++i) writer.write(sample_frame(i));
  }
  fs::resize_file(file, fs::file_size(file) / 2);
  FrameSource source(file);
  cv::Mat frame;
  int count = 0;
  while (source.read(frame)) ++count;
  EXPECT_GT(count, 5);
  EXPECT_LT(count, 35);
  EXPECT_THAT(source.trouble(), HasSubstr("of 40 cannot be decoded"));
}

TEST(FrameSource, TurnsPhoneVideoUprightUnlessTheCalibrationIsRaw) {
  const TemporaryFolder folder;
  const std::string file = folder / "v.mp4";
  {
    VideoWriter writer(file, {64, 48}, 25);
    cv::Mat left_half_white(48, 64, CV_8UC3, cv::Scalar::all(0));
    left_half_white.colRange(0, 32).setTo(cv::Scalar::all(255));
    for (int i = 0; i < 3; ++i) writer.write(left_half_white);
    writer.close();
  }
  turn_video(file, 90);
  cv::Mat frame;
  FrameSource upright(file, cv::Size(48, 64));
  EXPECT_EQ(upright.facts().rotation_deg, 90);
  EXPECT_TRUE(upright.facts().rotated);
  ASSERT_TRUE(upright.read(frame));
  ASSERT_EQ(frame.size(), cv::Size(48, 64));
  EXPECT_GT(frame.at<cv::Vec3b>(10, 24)[1], 200);  // clockwise: left is now above
  EXPECT_LT(frame.at<cv::Vec3b>(54, 24)[1], 50);

  FrameSource raw(file, cv::Size(64, 48));
  EXPECT_FALSE(raw.facts().rotated);
  ASSERT_TRUE(raw.read(frame));
  ASSERT_EQ(frame.size(), cv::Size(64, 48));
  EXPECT_GT(frame.at<cv::Vec3b>(24, 10)[1], 200);
  EXPECT_THAT(message_for(file, cv::Size(30, 30)), HasSubstr("found 48x64 px"));
}

TEST(FrameSource, GivesBackItsDecoderAndKeepsItsFacts) {
  const TemporaryFolder folder;
  write_sample_video(folder / "v.mp4", 5);
  FrameSource source(folder / "v.mp4");
  cv::Mat frame;
  ASSERT_TRUE(source.read(frame));
  source.close();
  EXPECT_FALSE(source.read(frame));
  EXPECT_FALSE(source.skip(1));
  EXPECT_EQ(source.facts().frame_count, 5);
  EXPECT_EQ(source.trouble(), "");
}

TEST(VideoWriter, LeavesNothingWithoutClose) {
  const TemporaryFolder folder;
  {
    VideoWriter writer(folder / "v.mp4", {64, 48}, 25);
    writer.write(sample_frame(0));
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(VideoWriter, LeavesOnlyTheVideo) {
  const TemporaryFolder folder;
  write_sample_video(folder / "v.mp4", 3);
  write_sample_video(folder / "v.mp4", 5);
  EXPECT_EQ(FrameSource(folder / "v.mp4").facts().frame_count, 5);
  EXPECT_EQ(std::distance(fs::directory_iterator(folder.path()), {}), 1);
}

TEST(VideoWriter, WritesTheSameBytesAgain) {
  const TemporaryFolder folder;
  write_sample_video(folder / "a.mp4", 30);
  write_sample_video(folder / "b.mp4", 30);
  EXPECT_EQ(read_file(folder / "a.mp4"), read_file(folder / "b.mp4"));
}

// Lets this thread use one processor only while it lives.
class OneProcessor {
 public:
  OneProcessor() {
    sched_getaffinity(0, sizeof(before_), &before_);
    int first = 0;
    while (!CPU_ISSET(first, &before_)) ++first;
    cpu_set_t one;
    CPU_ZERO(&one);
    CPU_SET(first, &one);
    sched_setaffinity(0, sizeof(one), &one);
  }
  ~OneProcessor() { sched_setaffinity(0, sizeof(before_), &before_); }

 private:
  cpu_set_t before_{};
};

// An encoder that takes as many threads as there are processors (for small frames it takes one)
// gives other bytes on each machine.
TEST(VideoWriter, WritesTheSameBytesWithOneProcessor) {
  const TemporaryFolder folder;
  const auto write = [&](const std::string& name) {
    VideoWriter writer(folder / name, {64, 192}, 25);
    for (int i = 0; i < 10; ++i) writer.write(cv::Mat(192, 64, CV_8UC3, cv::Scalar::all(20 * i)));
    writer.close();
    return read_file(folder / name);
  };
  const std::string all = write("all.mp4");
  const OneProcessor one;
  EXPECT_EQ(write("one.mp4"), all);
}

// A moving pattern, so that encoders have motion to encode.
cv::Mat moving_frame(int index) {
  cv::Mat frame(48, 64, CV_8UC3);
  for (int y = 0; y < frame.rows; ++y)
    for (int x = 0; x < frame.cols; ++x)
      frame.at<cv::Vec3b>(y, x) =
          cv::Vec3b(uchar(3 * x + 5 * index), uchar(5 * y), uchar(x + y + index));
  return frame;
}

// Each preset gives another file for the same frames, which is the same each time.
TEST(VideoWriter, EncodesByItsPreset) {
  const TemporaryFolder folder;
  std::set<std::string> files;
  for (const auto& [name, preset] : encoder_presets()) {
    std::set<std::string> of_preset;
    for (int i = 0; i < 8; ++i) {
      VideoWriter writer(folder / "v.mp4", {64, 48}, 25, preset);
      for (int frame = 0; frame < 50; ++frame) writer.write(moving_frame(frame));
      writer.close();
      of_preset.insert(read_file(folder / "v.mp4"));
    }
    EXPECT_EQ(of_preset.size(), 1u) << name;
    files.merge(of_preset);
    FrameSource source(folder / "v.mp4");
    EXPECT_EQ(source.facts().frame_count, 50);
    EXPECT_EQ(source.facts().frame_rate, 25);
    cv::Mat frame;
    for (int i = 0; i < 50; ++i) {
      ASSERT_TRUE(source.read(frame));
      EXPECT_LT(cv::norm(frame, moving_frame(i), cv::NORM_L1) / double(frame.total() * 3), 6);
    }
  }
}

TEST(VideoWriter, WithAPresetLeavesNothingWithoutClose) {
  const TemporaryFolder folder;
  {
    VideoWriter writer(folder / "v.mp4", {65, 49}, 29.97, EncoderPreset::kUltrafast);
    for (int i = 0; i < 5; ++i) writer.write(cv::Mat(49, 65, CV_8UC3, cv::Scalar::all(i)));
  }
  EXPECT_TRUE(fs::is_empty(folder.path()));
}

TEST(VideoWriter, SaysWhereItCannotWrite) {
  EXPECT_THROW(VideoWriter("/nowhere/v.mp4", {64, 48}, 25), std::runtime_error);
}

}  // namespace
}  // namespace walktrack
