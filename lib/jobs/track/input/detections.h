// The keypoints that come with a video's frames: from files that the scene names, or from the
// built-in network, which looks at every n-th frame.
//
// Cameras are independent of each other: those of one frame may be asked by threads of their own.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/config/config.h"
#include "io/keypoints/keypoint_file.h"
#include "io/scene/scene.h"
#include "jobs/track/input/person_finder.h"

namespace walktrack {
inline namespace jobs {

// Cameras up to which left and right may be in doubt without keypoints: from two sides silhouettes
// tell by themselves, if it is known what is behind them.
size_t cameras_in_doubt(const Scene& scene);
// Height of a person in the picture from which on the network is asked unless told otherwise: who
// is smaller does not fill the 192 px of its input, and of somebody of 70 px in black trousers it
// took one leg for the other for a whole stride.
inline constexpr double kLeastPerson_px = 150;

// How large a camera's images are worked on.
struct WorkingScale {
  double person_px;  // height of the standing subject in the image as it is filmed
  int shrink;        // factor by which images are shrunk
};
// Whether keypoints are used: as configured, or `auto`: where every camera has a file, and from the
// built-in network where there is one camera, with a video that shows people large enough, and the
// program has the network.
bool keypoints_wanted(const Scene& scene, const Config& config);
// Says that `auto` would have asked the network, if it were there; "" otherwise.
std::string missing_network_note(const Scene& scene, const Config& config);
// Whether flow is: as configured; `auto` is off, for it has not been seen to gain
// (observation/reports/flow.md).
bool flow_wanted(const Config& config);
// The configuration's terms with all that decided: on or off.
ObservationConfig decided_terms(const Scene& scene, const Config& config);

// What is asked for a frame of one camera.
struct FrameToLookAt {
  const cv::Mat& picture;  // as recorded
  int source = 0;          // what its video calls it
  int scene_frame = 0;     // from 0
  Region region;           // of the shrunk image
  bool around = false;     // whether the region is around the subject, and not everything
};

class Detections {
 public:
  // Nobody, ever.
  Detections() = default;
  // As the configuration says: reads the files, loads the network for cameras without. Errors of
  // keypoint_file.h and pose_net.h; UsageError where the network is wanted and not there.
  Detections(const Scene& scene, const KeypointConfig& config,
             std::span<const WorkingScale> scales);

  bool on() const { return !cameras_.empty(); }
  bool uses_network() const { return network_; }
  // What is odd about the files, one sentence each, beginning with the camera's name.
  std::vector<std::string> notes(const std::vector<int>& video_frames) const;

  // By camera; changes what is remembered of that camera.
  DetectedPeople look(size_t camera, const FrameToLookAt& frame);

 private:
  struct Viewer {
    std::string name;
    std::optional<KeypointFrames> file;
    std::optional<PoseNet> net;
    std::optional<PersonFinder> finder;
    int shrink = 1;
  };
  DetectedPeople seen_by_network(Viewer& viewer, const FrameToLookAt& frame) const;

  std::vector<Viewer> cameras_;
  int every_ = 1;
  double height_ = 0;  // of the subject, m
  bool network_ = false;
};

}  // namespace jobs
}  // namespace walktrack
