// Writes the frames of one camera as a video or as a folder of numbered PNG images. Images hold
// exactly what was rendered; a video encoder changes it, and not always in the same way.
#pragma once

#include <optional>
#include <string>

#include <opencv2/core/mat.hpp>

#include "io/archive/result_folder.h"
#include "io/video/video_writer.h"

namespace walktrack {
inline namespace jobs {

class FrameWriter {
 public:
  // Into <folder>/<name>.mp4 or, as images, <folder>/<name>/%06d.png. Throws std::runtime_error if
  // no encoder opens.
  FrameWriter(const ResultFolder& folder, const std::string& name, bool images, cv::Size size_px,
              double frame_rate);

  void write(const cv::Mat& frame);
  void close();

 private:
  const ResultFolder& folder_;
  std::string name_;
  size_t written_ = 0;  // images
  std::optional<VideoWriter> video_;
};

// The name that a scene calls such a video by.
std::string video_name(const std::string& name, bool images);

// What the result folder calls its file or files by.
std::string video_files(const std::string& name, bool images);

}  // namespace jobs
}  // namespace walktrack
