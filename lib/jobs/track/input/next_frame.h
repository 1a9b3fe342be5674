// A video's next frame on its way to evidence: decoded and prepared by itself, or beside the
// particles of the frame before, then completed.
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
  // What fetching took; CPU of the threads that did it for a camera each.
  struct Cost {
    Elapsed decode, prepare;
  };

  // All have to outlive this.
  NextFrame(const Scene& scene, SceneVideo& video, std::vector<Observer>& observers,
            Detections& detections);

  // Decodes the next frame and prepares it: where to look, by camera, and whether that is around
  // the subject. Cameras are shared by `threads`, and the rows of a single one by `row_threads`.
  // Changes no observer.
  Cost fetch(std::span<const Region> regions, bool around, int threads, int row_threads);
  // Prepares it again, to look elsewhere.
  void prepare(std::span<const Region> regions, bool around, int threads, int row_threads);

  bool fetched() const { return fetched_; }
  // Whether fetching found a frame: there is none after the last.
  bool there() const { return there_; }

  // Its evidence, by camera; `time` in s since the video's first frame. The next one can be fetched
  // then.
  void complete(double time, int threads, SceneEvidence& out);

  // After the last frame: gives back pictures and decoders.
  void close();

 private:
  const Scene& scene_;
  SceneVideo& video_;
  std::vector<Observer>& observers_;
  Detections& detections_;
  SceneFrames images_;
  std::vector<PreparedFrame> prepared_;
  std::vector<double> cpu_seconds_;  // of preparing, by camera
  bool fetched_ = false, there_ = false;
};

}  // namespace jobs
}  // namespace walktrack
