// Prepares a video's next frame: it is decoded and segmented, possibly in parallel with the
// particles of the frame before, and completed afterwards.
#pragma once

#include <span>
#include <vector>

#include "io/scene/scene.h"
#include "io/video/scene_video.h"
#include "jobs/track/input/detections.h"
#include "jobs/track/stopwatch.h"
#include "observation/observer.h"
#include "tracker/tracker_scene.h"

namespace walktrack {
inline namespace jobs {

class NextFrame {
 public:
  // Elapsed time of fetching, and CPU time of the threads that did it, one for each camera.
  struct Cost {
    Elapsed decode, prepare;
  };

  // The arguments have to outlive this object.
  NextFrame(const Scene& scene, SceneVideo& video, std::vector<Observer>& observers,
            Detections& detections);

  // Decodes the next frame and segments it in `regions`, by camera, which are around the subject if
  // `around` is set. Cameras are distributed over `threads`, and the rows of a single one over
  // `row_threads`. Changes no observer.
  Cost fetch(std::span<const Region> regions, bool around, int threads, int row_threads);
  // Segments it again in other regions.
  void prepare(std::span<const Region> regions, bool around, int threads, int row_threads);

  bool fetched() const { return fetched_; }
  // Whether there is a frame; false after the last one.
  bool there() const { return there_; }

  // Computes its evidence, by camera; `time` in s since the video's first frame. Afterwards the
  // next frame can be fetched.
  void complete(double time, int threads, SceneEvidence& out);

  // To be called after the last frame: frees images and decoders.
  void close();

 private:
  const Scene& scene_;
  SceneVideo& video_;
  std::vector<Observer>& observers_;
  Detections& detections_;
  SceneFrames frames_;
  std::vector<Image> pictures_;  // shrunk, by camera; empty without a video
  std::vector<PreparedFrame> prepared_;
  std::vector<double> cpu_seconds_;  // of segmentation, by camera
  bool fetched_ = false, there_ = false;
};

}  // namespace jobs
}  // namespace walktrack
