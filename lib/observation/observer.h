// One camera through time: frames in, evidence out.
//
// An Observer owns what the likelihood terms (terms.h) learn about one camera's images and turns
// each frame into CameraEvidence, which any number of threads may then ask about any number of
// poses. All pixels of evidence, regions and capsules are those of camera(), the camera of the
// shrunk image.
//
// It does so in two steps: most of the work can be done while poses of the frame before are still
// weighed (prepare); what depends on them, the walker's colours, comes last (complete).
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <optional>
#include <vector>

#include "camera/camera.h"
#include "observation/background/background.h"
#include "observation/keypoints/keypoints.h"
#include "observation/observation_config.h"
#include "observation/silhouette/planes.h"
#include "observation/terms.h"

namespace walktrack {
inline namespace observation {

// Where to look in a frame. Outside `area` nothing is computed and nothing is known.
struct Region {
  PixelRect area;
  double metres_per_px = .01;  // at the walker
  bool picture = false;        // whether the evidence is to hold the image itself
  bool points = true;          // whether a pose network may be asked
};

// The whole image, the walker at the size given.
Region whole_image(const Camera& camera, double metres_per_px);

// The image of a box on the ground: a person of that height whose root is above `position` (world
// x, y), with `margin` metres to all sides. Empty when none of it is in front of the camera.
Region person_region(const Camera& camera, const Eigen::Vector2d& position, double height,
                     double margin);

// What a frame shows, whatever the walker looks like. Keeps its memory from frame to frame.
class PreparedFrame {
 public:
  PreparedFrame();
  PreparedFrame(PreparedFrame&&) noexcept;
  PreparedFrame& operator=(PreparedFrame&&) noexcept;
  ~PreparedFrame();

 private:
  friend class Observer;
  struct Content;
  std::unique_ptr<Content> content_;
};

// Independent pixels in a pixel that shows so much of the walker.
double independent_share(const ObservationConfig& config, double metres_per_px);

// A thing in front of the walker: pixels of the calibrated (unshrunk) image.
using Polygon = std::vector<Eigen::Vector2d>;

struct ObserverInput {
  Camera camera;                                     // of the frames as they are given
  int shrink = 1;                                    // see shrink.h
  std::array<bool, kAppearanceCount> appearances{};  // in use; see appearances_of
  std::optional<BackgroundModel> background;  // of shrunk frames; needed if that term is enabled
  std::vector<Polygon> occluders;
  int threads = 1;       // that share the rows of a frame; the evidence is the same for any number
  bool pictures = true;  // false: all frames are empty, and only keypoints are given
};

// Which appearances a body's parts have.
std::array<bool, kAppearanceCount> appearances_of(const Body& body);

class Observer {
 public:
  // Throws InputError when the background is enabled and missing or of another size, unless there
  // are no pictures.
  Observer(const ObservationConfig& config, ObserverInput input);
  Observer(Observer&&) noexcept;
  Observer& operator=(Observer&&) noexcept;
  ~Observer();

  const Camera& camera() const;

  // The evidence of the next frame (8-bit BGR, of the size of the calibrated camera; empty = there
  // is no picture). Flow is measured against the frame of the last call. `out` keeps its memory
  // from frame to frame.
  void observe(const cv::Mat& frame_bgr, const Region& region, CameraEvidence& out,
               const DetectedPeople& people = {});

  // The same in two steps. `frame_bgr` has to stay as it is until the second, and the rows of the
  // first are shared by `threads`. Between them only learn() and hide() may be called.
  void prepare(const cv::Mat& frame_bgr, const Region& region, int threads, PreparedFrame& out,
               const DetectedPeople& people = {}) const;
  void complete(PreparedFrame& frame, CameraEvidence& out);

  // From the next frame on, these stand in front of the walker instead of ObserverInput::occluders.
  void hide(const std::vector<Polygon>& occluders);

  // Frames were dropped: the next one has no flow.
  void forget_previous_frame();

  // Whether any term of this configuration learns from poses.
  bool learns() const;
  // Learns in the frame observed last from a pose that fits it well. Without `body`, terms that ask
  // for more than capsules learn nothing.
  void learn(const CameraEvidence& evidence, const CapsuleList& capsules,
             const PosedBody* body = nullptr);

  // An observer made of the same configuration and input that takes the state of another one, left
  // there between two frames, continues like that one. InputError for a state of images of another
  // size.
  ObserverState state() const;
  void resume(ObserverState state);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace observation
}  // namespace walktrack
