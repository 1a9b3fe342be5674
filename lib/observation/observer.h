// Converts the frames of one camera to evidence.
//
// An Observer owns what the likelihood terms (terms.h) learn about one camera's images, and
// converts each frame to CameraEvidence, with which any number of threads may then evaluate any
// number of poses. All pixels of evidence, regions and capsules are those of camera(), the camera
// of the shrunk image.
//
// It does so in two steps: most of the work can be done while particles are still being weighted
// with the previous frame (prepare); what depends on their pose, the subject's colours, comes last
// (complete).
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

// The part of a frame that is used. Outside `area` nothing is computed.
struct Region {
  PixelRect area;
  double metres_per_px = .01;  // at the subject
  bool picture = false;        // whether the evidence has to contain the image itself, its colours
                               // if the subject's are not known yet
  bool points = true;          // whether a pose network may be run
  PixelRect subject{};         // the part around the subject; empty: all of it
};

// The whole image, with the subject at the size given.
Region whole_image(const Camera& camera, double metres_per_px);

// The image of a box on the ground: a person of that height whose root is above `position` (world
// x, y), with `margin` metres to all sides. Empty if no part of it is in front of the camera.
Region person_region(const Camera& camera, const Eigen::Vector2d& position, double height,
                     double margin);

// The evidence of a frame that does not depend on the subject's appearance. Keeps its memory from
// frame to frame.
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

// Number of independent pixels that a pixel of this size on the subject represents.
double independent_share(const ObservationConfig& config, double metres_per_px);

// An object in front of the subject: pixels of the calibrated (unshrunk) image.
using Polygon = std::vector<Eigen::Vector2d>;

struct ObserverInput {
  Camera camera;                                     // as calibrated
  int shrink = 1;                                    // see shrink.h
  std::array<bool, kAppearanceCount> appearances{};  // that are used; see appearances_of
  std::optional<BackgroundModel> background;  // of shrunk frames; needed if that term is enabled
  std::vector<Polygon> occluders;
  int threads = 1;       // for the rows of a frame; the evidence does not depend on it
  bool pictures = true;  // false: all frames are empty, and there are only keypoints
};

// The appearances of a body's parts.
std::array<bool, kAppearanceCount> appearances_of(const Body& body);

class Observer {
 public:
  // Throws InputError if the background is enabled and missing or of another size, unless there are
  // no images.
  Observer(const ObservationConfig& config, ObserverInput input);
  Observer(Observer&&) noexcept;
  Observer& operator=(Observer&&) noexcept;
  ~Observer();

  const Camera& camera() const;
  int shrink() const;
  // Of the model of the background; none without one.
  const PictureChange& change() const;
  // BackgroundModel::from_video of that model; 0 without one.
  double background_from_video() const;

  // Computes the evidence of the next frame (8-bit BGR, shrunk, of the size of camera(); empty =
  // there is no image). The previous frame for flow is that of the last call. `out` keeps its
  // memory from frame to frame.
  void observe(const cv::Mat& frame_bgr, const Region& region, CameraEvidence& out,
               const DetectedPeople& people = {});

  // The same in two steps. `frame_bgr` must not change until the second, and the rows of the first
  // are distributed over `threads`. Between them only learn() and hide() may be called.
  void prepare(const cv::Mat& frame_bgr, const Region& region, int threads, PreparedFrame& out,
               const DetectedPeople& people = {}) const;
  void complete(PreparedFrame& frame, CameraEvidence& out);

  // From the next frame on, replaces ObserverInput::occluders.
  void hide(const std::vector<Polygon>& occluders);

  // To be called after dropped frames: the next one has no flow.
  void forget_previous_frame();

  // Whether any term of this configuration learns from poses.
  bool learns() const;
  // Learns from the last frame with a pose that fits it well. Without `body`, terms that need more
  // than capsules learn nothing.
  void learn(const CameraEvidence& evidence, const CapsuleList& capsules,
             const PosedBody* body = nullptr);

  // An observer of the same configuration and input that takes the state of another one, taken
  // between two frames, continues in the same way. InputError for the state of images of another
  // size.
  ObserverState state() const;
  void resume(ObserverState state);

 private:
  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace observation
}  // namespace walktrack
