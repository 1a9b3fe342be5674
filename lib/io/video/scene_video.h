// The frames of all cameras of a scene, step by step in scene time.
//
// Scene frame n (n = first_frame, first_frame + 1, ...) is at time (n - first_frame) / rate. For
// each camera it contains the frame that was taken nearest to that time, counted from its
// start_frame. Cameras may therefore have different rates; a slow one shows the same frame several
// times, of which only the first is fresh. This also holds for dropped frames and variable rates:
// the container's time stamps, or the numbers of images, state when each frame was taken
// (io/ffmpeg/frame_stamps.h), and frames are paired by time. If a rate is stated, the time stamps
// are scaled to it, because a file's clock is wrong more often than the number of its frames; time
// stamps whose usual rate differs by more than a tenth from the stated one are ignored.
//
// A camera without a video has plain_frames().
#pragma once

#include <string>
#include <vector>

#include "io/scene/scene.h"
#include "io/video/video.h"

namespace walktrack {
inline namespace io {

struct SceneFrames {
  int number = 0;           // scene frame
  double time = 0;          // s since first_frame
  std::vector<char> fresh;  // by camera: whether it has a new frame since the last step
  std::vector<int> source;  // by camera: number of that frame in its video (FrameSource::number)
};

// Black images for a camera that has keypoints but no video, on which results can still be drawn:
// up to the last frame with keypoints.
FrameSource plain_frames(const SceneCamera& camera);

class SceneVideo {
 public:
  // Opens all videos and moves to first_frame. Throws an InputError for what cannot be read, for
  // sizes that differ from the calibration's, a missing frame rate, and a range beyond the end.
  explicit SceneVideo(const Scene& scene);

  double frame_rate() const { return rate_; }  // of scene steps, Hz
  // Number of scene frames from first_frame on, according to the containers; 0 = unknown.
  int frame_count() const;
  // Of the step that was read, it has the picture.
  const FrameSource& source(size_t camera) const { return sources_[camera]; }

  // Reads the next step. Returns false at the end of the range or of any video; trouble() states
  // the reason if that is too early.
  bool read(SceneFrames& frames);
  const std::string& trouble() const { return trouble_; }
  // Frees the decoders; facts about the videos are kept.
  void close();

 private:
  void refuse_late_starts(const Scene& scene) const;
  void refuse_late_times(const Scene& scene) const;
  void place_frames(size_t camera, const Scene& scene);
  double wanted(size_t camera) const;
  double place_of(size_t camera, int frame) const;
  int nearest(size_t camera, double place) const;
  bool advance(size_t camera, SceneFrames& frames);

  std::vector<FrameSource> sources_;
  // By camera and frame of its source: its time, in frames at the camera's rate from the first one
  // on. These are integers except after dropped frames and for variable rates. Empty: consecutive.
  std::vector<std::vector<double>> places_;
  std::vector<int> shown_;  // last frame of each source; -1 before the first
  std::vector<int> start_frames_;
  std::vector<double> rates_;  // Hz, by camera
  double rate_ = 0;
  int first_frame_ = 0, next_frame_ = 0;
  std::optional<int> last_frame_;
  std::string trouble_;
};

}  // namespace io
}  // namespace walktrack
