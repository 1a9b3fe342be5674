// The background model of a set of frames, with or without people in them.
#pragma once

#include <cstdint>
#include <vector>

#include "observation/background/background.h"
#include "observation/observation_config.h"

namespace walktrack {
inline namespace observation {

// Collects frames in bounded memory and makes the model of them. Frames may show people: each pixel
// takes the colour it shows most often, so a place must be free in the largest share of the frames,
// not in all.
class BackgroundSampler {
 public:
  // Frames are shrunk by the whole factor `shrink` by area averaging.
  BackgroundSampler(const BackgroundConfig& config, int shrink);

  // Frames are spread evenly over all that were added, whatever their number.
  void add(const cv::Mat& frame_bgr);

  int frames() const { return static_cast<int>(kept_.size()); }

  // The same for any number of threads. Throws InputError when no frame was added.
  BackgroundModel model(int threads = 1) const;

 private:
  BackgroundConfig config_;
  int shrink_;
  int64_t seen_ = 0, stride_ = 1;
  std::vector<std::vector<uint8_t>> kept_;  // BGR
  int width_ = 0, height_ = 0;
};

}  // namespace observation
}  // namespace walktrack
