#include "io/video/video_writer.h"

#include <stdexcept>

#include <fmt/format.h>

#include "io/archive/files.h"
#include "io/ffmpeg/h264_file.h"

namespace walktrack {
inline namespace io {

namespace fs = std::filesystem;

namespace {

std::unique_ptr<H264File> open_encoder(const fs::path& path, cv::Size size, double rate,
                                       EncoderPreset preset) {
  const cv::Size even(size.width & ~1, size.height & ~1);
  if (auto file = H264File::open(path, even, rate, preset)) return file;
  throw std::runtime_error(fmt::format("{}: no H.264 encoder opens for {}x{} px at {:g} Hz",
                                       path.string(), size.width, size.height, rate));
}

}  // namespace

VideoWriter::VideoWriter(const fs::path& path, cv::Size size_px, double frame_rate,
                         EncoderPreset preset)
    : path_(path), temporary_(new_temporary(path, ".mp4")) {
  try {
    encoder_ = open_encoder(temporary_, size_px, frame_rate, preset);
  } catch (...) {
    std::error_code ignored;
    fs::remove(temporary_, ignored);
    throw;
  }
}

VideoWriter::~VideoWriter() {
  if (!encoder_) return;
  encoder_.reset();
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

VideoWriter::VideoWriter(VideoWriter&&) noexcept = default;

void VideoWriter::write(const cv::Mat& frame) {
  try {
    encoder_->write(frame);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", path_.string(), error.what()));
  }
}

void VideoWriter::close() {
  try {
    encoder_->finish();
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", path_.string(), error.what()));
  }
  encoder_.reset();
  publish_file(temporary_, path_);
}

}  // namespace io
}  // namespace walktrack
