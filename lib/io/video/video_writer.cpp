#include "io/video/video_writer.h"

#include <stdexcept>

#include <fmt/format.h>
#include <opencv2/videoio.hpp>

#include "io/archive/files.h"
#include "io/ffmpeg/h264_file.h"
#include "io/ffmpeg/video_decoder.h"

namespace walktrack {
inline namespace io {

namespace fs = std::filesystem;

namespace {

std::unique_ptr<cv::VideoWriter> open_encoder(const fs::path& path, cv::Size size, double rate) {
  for (const int code :
       {cv::VideoWriter::fourcc('a', 'v', 'c', '1'), cv::VideoWriter::fourcc('m', 'p', '4', 'v')}) {
    auto writer =
        std::make_unique<cv::VideoWriter>(path.string(), cv::CAP_FFMPEG, code, rate, size);
    if (writer->isOpened()) return writer;
  }
  throw std::runtime_error(fmt::format("{}: no video encoder opens for {}x{} px at {:g} Hz",
                                       path.string(), size.width, size.height, rate));
}

}  // namespace

VideoWriter::VideoWriter(const fs::path& path, cv::Size size_px, double frame_rate,
                         std::optional<EncoderPreset> preset)
    : path_(path), temporary_(new_temporary(path, ".mp4")) {
  try {
    const cv::Size even(size_px.width & ~1, size_px.height & ~1);
    if (preset) chosen_ = H264File::open(temporary_, even, frame_rate, *preset);
    if (!chosen_) writer_ = open_encoder(temporary_, size_px, frame_rate);
  } catch (...) {
    std::error_code ignored;
    fs::remove(temporary_, ignored);
    throw;
  }
}

VideoWriter::~VideoWriter() {
  if (!writer_ && !chosen_) return;
  chosen_.reset();
  writer_.reset();
  std::error_code ignored;
  fs::remove(temporary_, ignored);
}

VideoWriter::VideoWriter(VideoWriter&&) noexcept = default;

void VideoWriter::write(const cv::Mat& frame) {
  ++frames_;
  if (writer_) return writer_->write(frame);
  try {
    chosen_->write(frame);
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", path_.string(), error.what()));
  }
}

void VideoWriter::close() {
  try {
    if (chosen_) chosen_->finish();
  } catch (const std::runtime_error& error) {
    throw std::runtime_error(fmt::format("{}: {}", path_.string(), error.what()));
  }
  if (writer_) writer_->release();
  // OpenCV's encoder reports no errors, so the file is opened to check it.
  const auto check = VideoDecoder::open(temporary_);
  const bool complete = check && check->frame_count() == frames_;
  if (frames_ > 0 && !complete) {
    throw std::runtime_error(fmt::format("{}: cannot be written completely", path_.string()));
  }
  chosen_.reset();
  writer_.reset();
  publish_file(temporary_, path_);
}

}  // namespace io
}  // namespace walktrack
