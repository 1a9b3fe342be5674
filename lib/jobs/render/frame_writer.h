// Writes the frames of one camera as a video or as a folder of numbered PNG images. Images are
// exactly what was rendered; a video encoder changes them, and different encoders do so
// differently.
#pragma once

#include <optional>
#include <string>

#include "io/archive/result_folder.h"
#include "io/video/video_writer.h"
#include "observation/image.h"

namespace walktrack {
inline namespace jobs {

class FrameWriter {
 public:
  // Writes <folder>/<name>.mp4 or, as images, <folder>/<name>/%06d.png. Throws std::runtime_error
  // if no encoder opens.
  FrameWriter(const ResultFolder& folder, const std::string& name, bool images, PixelSize size_px,
              double frame_rate);

  void write(const Image& frame);
  void close();

 private:
  const ResultFolder& folder_;
  std::string name_;
  size_t written_ = 0;  // images
  std::optional<VideoWriter> video_;
};

// The name of such a video in a scene.
std::string video_name(const std::string& name, bool images);

// The name of its file or files in the result folder's list.
std::string video_files(const std::string& name, bool images);

}  // namespace jobs
}  // namespace walktrack
