// The frames of all cameras of a scene, step by step in scene time.
//
// Scene frame n (n = first_frame, first_frame + 1, ...) is at time (n - first_frame) / rate. A
// camera shows the frame then that it took nearest to that moment, counted from its start_frame: so
// cameras of other rates are met, and a slow one shows the same frame several times, of which only
// the first is fresh. So does one that has dropped frames, or whose rate varies: a container's time
// stamps, or the numbers of images, tell when each frame was taken (io/video/frame_stamps.h), and
// frames are paired by time and not by count. A stated rate scales the stamps to itself, for files
// are wrong about their clock more often than about which frames they hold; stamps whose usual rate
// is more than a tenth off the stated one are not believed at all.
//
// A camera without a video shows plain_frames().
#pragma once

#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "io/scene/scene.h"
#include "io/video/video.h"

namespace walktrack {
inline namespace io {

struct SceneFrames {
  int number = 0;               // scene frame
  double time = 0;              // s since first_frame
  std::vector<cv::Mat> images;  // one a camera, 8-bit BGR; overwritten by the next read
  std::vector<char> fresh;      // whether the camera has a new frame since the last step
  std::vector<int> source;      // what that frame is called in its video (FrameSource::number)
};

// Plain pictures in place of the video of a camera that has keypoints alone: up to the last frame
// that they speak of.
FrameSource plain_frames(const SceneCamera& camera);

class SceneVideo {
 public:
  // Opens all videos and moves to first_frame. InputError for what cannot be read, sizes that are
  // not the calibration's, a missing frame rate, a range beyond the end.
  explicit SceneVideo(const Scene& scene);

  double frame_rate() const { return rate_; }  // of scene steps, Hz
  // Scene frames from first_frame on, as far as containers can be believed; 0 = not known.
  int frame_count() const;
  const FrameSource& source(size_t camera) const { return sources_[camera]; }

  // The next step; false when any camera or the range ends. trouble() then says why if it ended
  // before it should.
  bool read(SceneFrames& frames);
  const std::string& trouble() const { return trouble_; }
  // Gives back what decoding holds; what is known of the videos stays.
  void close();

 private:
  void place_frames(size_t camera, const Scene& scene);
  double wanted(size_t camera) const;
  double place_of(size_t camera, int frame) const;
  int nearest(size_t camera, double place) const;
  bool advance(size_t camera, SceneFrames& frames);

  std::vector<FrameSource> sources_;
  // By camera and frame of its source: where it lies, in frames at the camera's rate from the first
  // one on; whole numbers but for dropped frames and rates that vary. Empty: one after another.
  std::vector<std::vector<double>> places_;
  std::vector<int> shown_;  // frame of each source; -1 before the first
  std::vector<int> start_frames_;
  std::vector<double> rates_;  // Hz, of each camera
  double rate_ = 0;
  int first_frame_ = 0, next_frame_ = 0;
  std::optional<int> last_frame_;
  std::string trouble_;
};

}  // namespace io
}  // namespace walktrack
