#include "jobs/render/frame_writer.h"

#include <vector>

#include <fmt/format.h>
#include <opencv2/imgcodecs.hpp>

#include "io/archive/files.h"

namespace walktrack {

namespace fs = std::filesystem;

FrameWriter::FrameWriter(const fs::path& folder, const std::string& name, bool images,
                         cv::Size size_px, double frame_rate) {
  if (!images) {
    video_.emplace(folder / film_name(name, images), size_px, frame_rate);
    return;
  }
  images_ = folder / name;
  fs::create_directories(images_);
}

void FrameWriter::write(const cv::Mat& frame) {
  if (video_) {
    video_->write(frame);
    return;
  }
  std::vector<uint8_t> bytes;
  cv::imencode(".png", frame, bytes);
  write_file_atomically(images_ / fmt::format("{:06}.png", written_),
                        {reinterpret_cast<const char*>(bytes.data()), bytes.size()});
  ++written_;
}

void FrameWriter::close() {
  if (video_) {
    video_->close();
    return;
  }
  for (size_t i = written_; fs::remove(images_ / fmt::format("{:06}.png", i)); ++i) continue;
}

std::string film_name(const std::string& name, bool images) {
  return images ? name : name + ".mp4";
}

}  // namespace walktrack
