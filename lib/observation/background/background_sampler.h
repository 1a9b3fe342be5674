// Estimates the background model from frames with or without people.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "observation/background/background.h"
#include "observation/observation_config.h"

namespace walktrack {
inline namespace observation {

// Collects frames in bounded memory and estimates the model from them. Frames may show people: each
// pixel gets its most frequent colour, so that a place has to be free in the largest share of the
// frames, not in all.
class BackgroundSampler {
 public:
  explicit BackgroundSampler(const BackgroundConfig& config);

  // To be called for every frame. The frames that are kept are spread evenly over all of them,
  // whatever their number: whether this one is to be given to take().
  bool takes_next();
  void take(const cv::Mat& frame_bgr);
  // Both.
  void add(const cv::Mat& frame_bgr);

  int frames() const { return static_cast<int>(kept_.size()); }
  // One of the frames that are kept, in BGR; valid until the next frame is added.
  cv::Mat frame(int index) const;

  // Excludes from the model the pixels of a kept frame at which `mask` (8-bit, of that frame's
  // size) is not 0. A pixel that is free in hardly any frame becomes kNeverSeen. To be called after
  // the last frame was added.
  void hide(int index, const cv::Mat& mask);

  // Shows a frame of the video, which is not kept: in its contrast people count as well, who may be
  // darker and brighter than the empty scene. To be called after the last frame was added.
  void show(const cv::Mat& frame_bgr);
  // Whether all frames, and those that were shown, have little contrast (levels.h); false before
  // one was shown.
  bool has_little_contrast() const;

  // Dark frames and those of little contrast are stretched over more levels, and frames without
  // colours are compared by luma alone (picture_change.h). The result does not depend on `threads`.
  // Throws InputError if no frame was added.
  BackgroundModel model(int threads = 1) const;

 private:
  PictureChange change() const;
  // Standard deviation of luma over the frames that are kept, grey levels: its median over the
  // picture; 0 of a single frame.
  float noise() const;

  BackgroundConfig config_;
  int64_t seen_ = 0, stride_ = 1;
  std::vector<std::vector<uint8_t>> kept_;    // BGR
  std::vector<std::vector<uint8_t>> hidden_;  // by kept frame: 0 = used; empty = all used
  int width_ = 0, height_ = 0;
  std::optional<LumaRange> range_;  // of all frames, once one was shown
};

}  // namespace observation
}  // namespace walktrack
