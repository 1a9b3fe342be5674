#include "jobs/render/frame_writer.h"

#include <fmt/format.h>

#include "io/drawing/picture.h"
#include "observation/image.h"

namespace walktrack {
inline namespace jobs {

FrameWriter::FrameWriter(const ResultFolder& folder, const std::string& name, bool images,
                         PixelSize size_px, double frame_rate)
    : folder_(folder), name_(name) {
  if (images) {
    std::filesystem::create_directories(folder.path() / name);
  } else {
    video_.emplace(folder.file(video_name(name, images)), size_px, frame_rate);
  }
}

void FrameWriter::write(const Image& frame) {
  if (video_) {
    video_->write(frame);
    return;
  }
  folder_.write(fmt::format("{}/{:06}.png", name_, written_), png_bytes(frame));
  ++written_;
}

void FrameWriter::close() {
  if (video_) video_->close();
}

std::string video_name(const std::string& name, bool images) {
  return images ? name : name + ".mp4";
}

std::string video_files(const std::string& name, bool images) {
  return images ? numbered_files(name, ".png") : video_name(name, images);
}

}  // namespace jobs
}  // namespace walktrack
