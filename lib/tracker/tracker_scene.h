// Everything that the frames of a scene share, and the evidence of one frame.
#pragma once

#include <limits>
#include <optional>
#include <span>
#include <vector>

#include "camera/camera.h"
#include "gait/prior/gait_prior.h"
#include "observation/observer.h"
#include "tracker/detect/detector_config.h"
#include "tracker/detect/stature.h"
#include "tracker/state/particle.h"

namespace walktrack {
inline namespace tracker {

struct TrackerScene {
  std::vector<Camera> cameras;  // of the images from which the evidence comes (Observer::camera)
  BodyModel model;
  ObservationConfig observation;
  bool pictures = true;  // of any camera; otherwise there are only keypoints
  double dt = 1.0 / 30;  // s between frames
  // Where the walk starts; if it is missing, or nobody is there, the walk is searched.
  std::optional<DetectedWalk> initial;
  int initial_frame = 0;
  std::optional<double> initial_phase;  // of the stride, 0 = left foot strike
  // Where the subject is in a frame, on the ground, m; who walks elsewhere is somebody else.
  struct SubjectPlace {
    Eigen::Vector2d position;
    double frame;
  };
  std::optional<SubjectPlace> near{};
  bool size_known = true;            // the height of the model is right; otherwise it is estimated
  bool girth_known = false;          // the same of its girth
  bool trunk_known = false;          // and of the length of its trunk
  std::optional<Stature> stature{};  // what is known of it then; nullopt: nothing
  // By camera: how many pixels of its video each pixel of `cameras` is; empty: one.
  std::vector<int> shrink{};
};

// The detector's limits, adapted to the scene: outlines may count in part only, and keypoints alone
// contain far less evidence than images.
DetectorConfig detector_for(const TrackerScene& scene, DetectorConfig config);

// Number of frames, `dt` s apart, in a span of time, at least two.
int frames_in(double seconds, double dt);

// By camera, in the order of TrackerScene::cameras.
using SceneEvidence = std::vector<CameraEvidence>;

// The usual gait of a speed (m/s) on the slope of `heading`.
PriorGait usual_gait(const BodyModel& model, const GaitPrior& prior, double speed, double heading);

// A walker's poses over a step of the usual gait of a speed (m/s) on the slope of `heading`, with
// the root above the origin and the pose's own heading 0. In every frame one of them resembles such
// a walker, whichever foot stands.
std::vector<Pose> walking_figures(const BodyModel& model, const GaitPrior& prior, double speed,
                                  double heading);

// The same for all walking speeds and all headings.
class PoseTemplates {
 public:
  PoseTemplates(const BodyModel& model, const GaitPrior& prior);
  std::span<const Pose> at(double speed, double heading) const;

 private:
  Eigen::Vector2d downhill_;
  std::vector<std::vector<Pose>> figures_;  // by slope and speed, which is the faster index
};

// Of some figures the one that fits best.
struct BestFigure {
  double score = -std::numeric_limits<double>::infinity();  // log-likelihood, nats
  size_t index = 0;                                         // of the figure
  Pose pose{};                                              // of the figure at its place
};

// With the root above `position`. `body`: the figures'.
BestFigure best_figure(const TrackerScene& scene, const SceneEvidence& evidence, const Body& body,
                       std::span<const Pose> figures, const Eigen::Vector2d& position,
                       double heading);

// Its log-likelihood.
double place_score(const TrackerScene& scene, const SceneEvidence& evidence, const Body& body,
                   std::span<const Pose> figures, const Eigen::Vector2d& position, double heading);

// The same by outlines alone.
double outline_score(const TrackerScene& scene, const SceneEvidence& evidence, const Body& body,
                     std::span<const Pose> figures, const Eigen::Vector2d& position,
                     double heading);

}  // namespace tracker
}  // namespace walktrack
