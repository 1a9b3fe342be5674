#include "jobs/track/track_setup.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/anthropometry.h"
#include "core/errors.h"
#include "core/parallel_for.h"
#include "jobs/track/input/learned_background.h"
#include "observation/flow/flow.h"
#include "observation/shrink.h"
#include "tracker/detect/figure_places.h"
#include "tracker/detect/walk_search.h"
#include "tracker/motion/models/planar_body.h"
#include "tracker/motion/standing.h"

namespace walktrack {
inline namespace jobs {

namespace {

// Share of the places that are farther: a subject who comes this near must not be blurred, but one
// further off may be seen at a lower resolution.
constexpr double kNearShare = 0.7;
constexpr double kFallbackDistance = 10;  // m, where no place on the ground is in view
// Of each pixel while a subject is searched by their clothes (tracker/detect/clothes.h): its colour
// and the background's density; log-ratios of all classes, in less than half of the picture.
constexpr double kClothesBytes = 2 * sizeof(uint16_t) + 2 * sizeof(int32_t);

// Expected height of the subject in the image.
double expected_height_px(const Scene& scene, const Camera& camera, const DetectorConfig& config) {
  const double height = scene.subject.height;
  if (scene.initial) {
    const double there = height_px(camera, scene.initial->position, height);
    if (there > 0) return there;
  }
  std::vector<double> heights;
  for (const auto& place : standing_places({&camera, 1}, height, config))
    heights.push_back(height_px(camera, place, height));
  if (heights.empty()) return camera.focal_px.y() * height / kFallbackDistance;
  const auto chosen = heights.begin() + static_cast<long>(kNearShare * double(heights.size() - 1));
  std::nth_element(heights.begin(), chosen, heights.end());
  return *chosen;
}

// `learned`: the state of the observer before, if there is one.
Observer make_observer(const Scene& scene, const SceneCamera& camera, const Config& config,
                       const Body& body, const std::optional<BackgroundModel>& background,
                       const ObserverState* learned) {
  const ObservationConfig& observation = config.observation;
  ObserverInput input;
  input.camera = camera.camera;
  const WorkingScale scale = working_scale(scene, camera.camera, config);
  input.shrink = scale.shrink;
  input.appearances = appearances_of(body);
  // Several cameras share the threads.
  input.threads = scene.cameras.size() == 1 ? thread_count(config.threads) : 1;
  input.occluders = occluders_at(camera, 0);
  input.pictures = !camera.video.empty();
  if (background) input.background = *background;
  if (learned) input.background = learned->background;
  Observer observer(observation, std::move(input));
  if (learned) observer.resume(*learned);
  return observer;
}

void set_beginning(const Scene& scene, double frame_rate, TrackerScene& out) {
  if (scene.near) out.near = {scene.near->position, scene.near->time * frame_rate};
  if (!scene.initial) return;
  const InitialState& given = *scene.initial;
  const double speed = given.speed.value_or(anthropometry::kUsualSpeed);
  out.initial = DetectedWalk{
      .position = given.position,
      .velocity = speed * Eigen::Vector2d(std::cos(given.heading), std::sin(given.heading)),
      .given = true};
  out.initial_frame = static_cast<int>(std::lround(given.time * frame_rate));
  out.initial_phase = given.phase;
}

Detections detections_of(const Scene& scene, const Config& config, double frame_rate) {
  if (config.observation.keypoints.enabled == TermSetting::kOff) return {};
  std::vector<WorkingScale> scales;
  for (const SceneCamera& camera : scene.cameras)
    scales.push_back(working_scale(scene, camera.camera, config));
  return Detections(scene, config.observation.keypoints, frame_rate, scales);
}

}  // namespace

WorkingScale working_scale(const Scene& scene, const Camera& camera, const Config& config) {
  const double person_px = expected_height_px(scene, camera, config.tracker.detector);
  return {person_px, shrink_factor(person_px, config.observation.person_px)};
}

TrackSetup set_up(const Scene& scene, const Config& config, double frame_rate,
                  std::span<const ObserverState> learned, const JobControl& control) {
  TrackSetup setup;
  TrackerScene& out = setup.scene;
  const double gravity = scene.gravity.norm();
  out.size_known = scene.height_given;
  out.girth_known = scene.girth_given;
  out.trunk_known = scene.subject.lengths.trunk.has_value();
  if (scene.height_sd) out.stature = Stature{scene.subject.height, *scene.height_sd};
  out.model.body = make_body(scene.subject, config.body);
  out.model.walker = kneed_model(kneed_parameters(scene.subject, gravity));
  out.model.downhill = scene.gravity.head<2>();
  out.model.path = config.tracker.motion.path;
  if (!out.model.downhill.isZero()) out.model.walker.gravity.y() = scene.gravity.z();
  out.observation = config.observation;
  out.pictures = std::any_of(scene.cameras.begin(), scene.cameras.end(),
                             [](const SceneCamera& camera) { return !camera.video.empty(); });
  out.dt = 1.0 / frame_rate;
  set_beginning(scene, frame_rate, out);
  std::vector<std::optional<BackgroundModel>> backgrounds(scene.cameras.size());
  if (learned.empty() && config.observation.background.enabled)
    backgrounds = learned_backgrounds(scene, config, control);
  for (size_t c = 0; c < scene.cameras.size(); ++c) {
    setup.observers.push_back(make_observer(scene, scene.cameras[c], config, out.model.body,
                                            backgrounds[c],
                                            learned.empty() ? nullptr : &learned[c]));
    out.cameras.push_back(setup.observers.back().camera());
    out.shrink.push_back(setup.observers.back().shrink());
  }
  setup.detections = detections_of(scene, config, frame_rate);
  return setup;
}

void learn_appearance(const Body& body, const Pose& pose, const SceneEvidence& evidence,
                      int threads, TrackSetup& setup) {
  const PosedBody found(body, pose);
  parallel_for(setup.observers.size(), threads, [&](size_t c) {
    setup.observers[c].learn(evidence[c], project_parts(setup.scene.cameras[c], found.parts),
                             &found);
  });
}

double search_window_bytes(const Scene& scene, const Config& config, double frame_rate) {
  double pixels = 0;
  for (const SceneCamera& each : scene.cameras) {
    const double shrink = working_scale(scene, each.camera, config).shrink;
    pixels += each.camera.width_px / shrink * (each.camera.height_px / shrink);
  }
  const double flow_bytes =
      is_on(config.observation.flow) ? sizeof(FlowCell) + sizeof(EarlierPixel) : 0;
  const ObservationConfig& terms = config.observation;
  const bool clothes =
      scene.cameras.size() == 1 && terms.background.enabled && terms.foreground.enabled;
  const double seconds =
      config.tracker.detector.window + WalkSearch::kept_seconds(may_stand(config.tracker.motion));
  return std::ceil(seconds * frame_rate) * pixels *
         (sizeof(int32_t) + flow_bytes + (clothes ? kClothesBytes : 0));
}

void require_speeds_in_order(const DetectorConfig& config) {
  if (config.slowest > config.fastest)
    throw UsageError(describe({"", 0, "detector.slowest"}, fmt::format("{:g}", config.slowest),
                              fmt::format("at most detector.fastest, {:g}", config.fastest)));
}

void require_room_for_search(const Scene& scene, const Config& config, double frame_rate) {
  constexpr double kGb = 1e9;
  const double bytes = search_window_bytes(scene, config, frame_rate);
  if (bytes <= kMostSearchBytes) return;
  throw InputError(describe(
      {scene.file.string(), 0, ""},
      fmt::format("a frame rate and images for which the search would hold {:.1f} GB", bytes / kGb),
      fmt::format("at most {:.1f} GB: a smaller observation.person_px shrinks images further, a "
                  "video of fewer frames/s holds less",
                  kMostSearchBytes / kGb)));
}

Region search_region(const Camera& camera, double subject_height) {
  std::vector<double> scales;
  for (const auto& place : standing_places({&camera, 1}, subject_height, DetectorConfig{}))
    scales.push_back(subject_height / height_px(camera, place, subject_height));
  if (scales.empty()) return whole_image(camera, kFallbackDistance / camera.focal_px.y());
  std::nth_element(scales.begin(), scales.begin() + static_cast<long>(scales.size() / 2),
                   scales.end());
  return whole_image(camera, scales[scales.size() / 2]);
}

}  // namespace jobs
}  // namespace walktrack
