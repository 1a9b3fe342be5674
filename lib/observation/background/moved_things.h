// Things that the images of the empty scene show and the video does not, or the other way round:
// a chair that was moved, a carpet that was rolled up, the shadow of another hour. To a background
// model of the empty scene they are somebody who stands there throughout.
//
// Pixels belong to such a thing if no frame looks like the empty scene there, and most frames
// look alike. A subject who hardly moves has such pixels, too; but around them are arms, legs and a
// head that come and go, while a thing ends where the empty scene begins.
// observation/reports/background.md has measurements.
#pragma once

#include <opencv2/core/mat.hpp>

#include "observation/background/background.h"
#include "observation/background/background_sampler.h"

namespace walktrack {
inline namespace observation {

class MovedThings {
 public:
  // `empty_scene` has to outlive this. `least_px`: side of the smallest thing. Results do not
  // depend on `threads`.
  MovedThings(const BackgroundConfig& config, const BackgroundModel& empty_scene, double least_px,
              int threads);

  // Adds a frame of the video, BGR, of the model's size.
  void compare(const cv::Mat& bgr);
  // Whether something may be as the empty scene shows it in none of the frames so far.
  bool possible() const;
  // A copy of the empty scene's model with the pixels of things as the video shows them, and their
  // share in `from_video`. Too few frames have no things.
  BackgroundModel corrected() const;

 private:
  BackgroundConfig config_;
  const BackgroundModel& empty_scene_;
  double least_px_;
  int threads_;
  BackgroundSampler frames_;  // spread over those that were compared
  cv::Mat unlike_count_;      // how many of those are unlike the empty scene, 32 bits
  int compared_ = 0;
};

}  // namespace observation
}  // namespace walktrack
