#include "tests/io/sample_video.h"

#include <cmath>
#include <filesystem>
#include <fstream>
#include <iterator>

#include <opencv2/core.hpp>
#include <opencv2/imgcodecs.hpp>
#include <opencv2/videoio.hpp>

#include "io/video/video_writer.h"

namespace walktrack {

namespace {
constexpr double kLevelsPerNumber = 10;
}

cv::Mat sample_frame(int number) {
  return cv::Mat(48, 64, CV_8UC3, cv::Scalar::all(kLevelsPerNumber * (number % 25) + 5));
}

int shown_number(const cv::Mat& frame) {
  return static_cast<int>(std::lround((cv::mean(frame)[1] - 5) / kLevelsPerNumber));
}

void write_sample_video(const std::string& path, int frames) {
  VideoWriter writer(path, {64, 48}, 25);
  for (int i = 0; i < frames; ++i) writer.write(sample_frame(i));
  writer.close();
}

namespace {

std::string file_bytes(const std::string& path) {
  std::ifstream in(path, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

std::string big_endian(size_t value) {
  std::string out;
  for (const int shift : {24, 16, 8, 0}) out += static_cast<char>((value >> shift) & 0xff);
  return out;
}

size_t number_at(const std::string& bytes, size_t at) {
  size_t out = 0;
  for (size_t i = 0; i < 4; ++i) out = out << 8 | static_cast<unsigned char>(bytes[at + i]);
  return out;
}

}  // namespace

// An MP4 file lists the durations of its frames (ISO 14496-12, stts); the list is replaced. The
// encoder has no reordered frames, and writes the lists after the frames.
void write_timed_video(const std::string& path, const std::vector<cv::Mat>& frames, double rate,
                       const std::vector<double>& durations) {
  cv::VideoWriter writer(path, cv::CAP_FFMPEG, cv::VideoWriter::fourcc('m', 'p', '4', 'v'), rate,
                         frames.front().size());
  for (const cv::Mat& frame : frames) writer.write(frame);
  writer.release();
  std::string bytes = file_bytes(path);
  const size_t list = bytes.find("stts");
  const size_t usual = number_at(bytes, list + 16), old_size = number_at(bytes, list - 4);
  std::string entries = big_endian(0) + big_endian(durations.size());
  for (const double duration : durations)
    entries += big_endian(1) + big_endian(static_cast<size_t>(duration * double(usual)));
  const size_t size = 8 + entries.size();
  bytes.replace(list - 4, old_size, big_endian(size) + "stts" + entries);
  for (const char* box : {"moov", "trak", "mdia", "minf", "stbl"}) {
    const size_t at = bytes.find(box) - 4;
    bytes.replace(at, 4, big_endian(number_at(bytes, at) + size - old_size));
  }
  bytes.replace(bytes.find("edts"), 4, "free");  // which would end the video where it ended before
  std::ofstream(path, std::ios::binary) << bytes;
}

void write_uneven_video(const std::string& path, const std::vector<double>& durations) {
  std::vector<cv::Mat> frames;
  for (size_t i = 0; i < durations.size(); ++i) frames.push_back(sample_frame(static_cast<int>(i)));
  write_timed_video(path, frames, 25, durations);
}

// Phones write the sensor's pixels and a rotation in the track header (tkhd, matrix).
void turn_video(const std::string& path, int clockwise_deg) {
  std::string bytes = file_bytes(path);
  const std::string none(4, '\0'), one{"\0\1\0\0", 4}, minus{"\xff\xff\0\0", 4};
  const std::string& cosine = clockwise_deg == 180 ? minus : none;
  const std::string& sine = clockwise_deg == 90 ? one : clockwise_deg == 270 ? minus : none;
  const std::string& opposite = clockwise_deg == 90 ? minus : clockwise_deg == 270 ? one : none;
  const std::string turn = cosine + sine + none + opposite + cosine;
  bytes.replace(bytes.find("tkhd") + 44, turn.size(), turn);
  std::ofstream(path, std::ios::binary) << bytes;
}

void trim_video(const std::string& path, int frames) {
  std::string bytes = file_bytes(path);
  const auto number = [&](size_t at) {
    uint32_t value = 0;
    for (size_t i = 0; i < 4; ++i) value = value << 8 | static_cast<uint8_t>(bytes[at + i]);
    return value;
  };
  const uint32_t ticks = number(bytes.find("mdhd") + 16) / 25;  // of a frame
  const size_t at = bytes.find("elst") + 16;                    // media time of the first entry
  const uint32_t begin = number(at) + static_cast<uint32_t>(frames) * ticks;
  for (size_t i = 0; i < 4; ++i) bytes[at + i] = static_cast<char>(begin >> (24 - 8 * i));
  std::ofstream(path, std::ios::binary) << bytes;
}

void write_sample_images(const std::string& folder, const std::vector<int>& numbers) {
  std::filesystem::create_directories(folder);
  for (const int number : numbers) {
    cv::imwrite(folder + "/frame" + std::to_string(number) + ".png", sample_frame(number));
  }
}

}  // namespace walktrack
