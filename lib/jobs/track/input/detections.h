// The keypoints of a video's frames: from files that the scene names, or from the built-in network,
// which looks at some frames of each camera.
//
// Cameras are independent of each other: those of one frame may be processed by different threads.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "io/config/config.h"
#include "io/keypoints/keypoint_file.h"
#include "io/scene/scene.h"
#include "io/video/video.h"
#include "jobs/track/input/person_finder.h"
#include "observation/image.h"

namespace walktrack {
inline namespace jobs {

// The number of cameras up to which left and right may be uncertain without keypoints: silhouettes
// from two sides determine them if the background is known.
size_t cameras_in_doubt(const Scene& scene);
// Height of a person in the image from which on the network is used by default. A smaller person
// does not fill the 192 px of its input; for a person of 70 px in black trousers it confused the
// legs for a whole stride.
inline constexpr double kLeastPerson_px = 150;

// The scale at which a camera's images are processed.
struct WorkingScale {
  double person_px;  // height of the standing subject in the recorded image
  int shrink;        // factor by which images are shrunk
};
// Whether keypoints are used: as configured. `auto` means yes if every camera has a file, or if
// there is one camera with a video that shows people large enough and the program has the network.
bool keypoints_wanted(const Scene& scene, const Config& config);
// Why `auto` does not ask the network though one camera leaves left and right in doubt: it is not
// there, or people are too small for it. "" otherwise.
std::string missing_network_note(const Scene& scene, const Config& config);
// Whether optical flow is used: as configured. `auto` means no, because no improvement was measured
// (observation/reports/flow.md).
bool flow_wanted(const Config& config);
// The configuration with what it leaves to the scene: terms are on or off, evidence has its
// weights, particles have a number, sliding feet a limit.
Config decided(const Scene& scene, const Config& config);

// Frames from one look of the network to the next: as configured, or three, or fewer in a slow
// video (`frame_rate`, Hz), for some ten looks a second.
int frames_between_looks(const KeypointConfig& config, double frame_rate);

// The input for one frame of one camera.
struct FrameToLookAt {
  const FrameSource& video;  // has the picture as recorded
  int source = 0;            // frame number in its video
  int scene_frame = 0;       // from 0
  Region region;             // of the shrunk image
  bool around = false;       // whether the region is around the subject, and not the whole image
};

class Detections {
 public:
  // Detects nobody.
  Detections() = default;
  // As configured: reads the files, and loads the network for cameras without files. Errors of
  // keypoint_file.h and pose_net.h; UsageError if the network is wanted and missing.
  Detections(const Scene& scene, const KeypointConfig& config, double frame_rate,
             std::span<const WorkingScale> scales);

  bool on() const { return !cameras_.empty(); }
  bool uses_network() const { return network_; }
  // Irregularities of the files, one sentence each, beginning with the camera's name.
  std::vector<std::string> notes(const std::vector<int>& video_frames) const;

  // Detects people in a frame of a camera, and updates the state of that camera.
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
