// Where the frames of one camera go: a video, or a folder of numbered PNG images. Images hold what
// was rendered to the last bit; an encoder adds its own, and does not promise the same twice.
#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include <opencv2/core/mat.hpp>

#include "io/video/video_writer.h"

namespace walktrack {

class FrameWriter {
 public:
  // Into <folder>/<name>.mp4 or, as images, <folder>/<name>/%06d.png; images of an earlier run that
  // are beyond this one's last are removed. Throws std::runtime_error if no encoder opens.
  FrameWriter(const std::filesystem::path& folder, const std::string& name, bool images,
              cv::Size size_px, double frame_rate);

  void write(const cv::Mat& frame);
  void close();

 private:
  std::filesystem::path images_;  // their folder
  size_t written_ = 0;
  std::optional<VideoWriter> video_;
};

// The name that a scene calls such a film by.
std::string film_name(const std::string& name, bool images);

}  // namespace walktrack
