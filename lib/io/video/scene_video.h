// The frames of all cameras of a scene, step by step in scene time.
//
// Scene frame n (n = first_frame, first_frame + 1, ...) is at time (n - first_frame) / rate. A
// camera shows its frame start_frame + round(n * camera_rate / rate) then: cameras of other rates
// are met at their nearest frame, and a slow one shows the same frame several times, of which only
// the first is fresh. So does one that has dropped frames: a container's time stamps tell where,
// and the frames after the gap keep their time.
//
// A camera without a video shows plain_frames().
#pragma once

#include <string>
#include <vector>

#include <opencv2/core/mat.hpp>

#include "io/scene/scene.h"
#include "io/video/video.h"

namespace walktrack {

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

 private:
  int camera_frame(size_t camera, int scene_frame) const;
  bool advance(size_t camera, SceneFrames& frames);
  bool read_ahead(size_t camera);

  // The newest frame of a source, which may be too early to show.
  struct Ahead {
    int number = -1;   // at the camera's rate, counting those that were dropped
    double stamp = 0;  // s
    int source = 0;    // see SceneFrames
    bool waits = false;
    cv::Mat image;
  };

  std::vector<FrameSource> sources_;
  std::vector<Ahead> ahead_;
  std::vector<int> start_frames_;
  std::vector<double> rates_;  // Hz, of each camera
  double rate_ = 0;
  int first_frame_ = 0, next_frame_ = 0;
  std::optional<int> last_frame_;
  std::string trouble_;
};

}  // namespace walktrack
