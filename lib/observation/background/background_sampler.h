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
  // One of those that are kept: shrunk, BGR; valid until the next is added.
  cv::Mat frame(int index) const;

  // Leaves out of the model what a kept frame shows where `mask` (8-bit, of that frame's size) is
  // not 0. A pixel that hardly any frame shows free is kNeverSeen. After the last frame was added.
  void hide(int index, const cv::Mat& mask);

  // The same for any number of threads. Throws InputError when no frame was added.
  BackgroundModel model(int threads = 1) const;

 private:
  BackgroundConfig config_;
  int shrink_;
  int64_t seen_ = 0, stride_ = 1;
  std::vector<std::vector<uint8_t>> kept_;    // BGR
  std::vector<std::vector<uint8_t>> hidden_;  // by kept frame: 0 = counts; empty = all counts
  int width_ = 0, height_ = 0;
};

}  // namespace observation
}  // namespace walktrack
