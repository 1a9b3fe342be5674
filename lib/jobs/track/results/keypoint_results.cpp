#include "jobs/track/results/keypoint_results.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include "io/drawing/overlay.h"
#include "jobs/track/track_setup.h"
#include "observation/shrink.h"

namespace walktrack {
inline namespace jobs {

namespace {

constexpr double kNothing = std::numeric_limits<double>::quiet_NaN();

// Where a pixel of the shrunk image is in the picture.
Eigen::Vector2d picture_px(const Eigen::Vector2d& shrunk_px, int shrink) {
  return (shrunk_px.array() + 0.5) * shrink - 0.5;
}

ImageColour colour_of(size_t point) {
  if (point == 0) return trunk_colour();
  return point < mirrored(point) ? left_colour() : right_colour();
}

bool any(const std::vector<double>& values) {
  return !std::all_of(values.begin(), values.end(), [](double value) { return std::isnan(value); });
}

}  // namespace

double keypoint_residual(const KeypointEvidence& seen, const Camera& camera, int shrink,
                         const Body& body, const Pose& pose) {
  const Camera small = scaled_down(camera, shrink);
  const PointPixels predicted = point_pixels(small, PosedBody(body, pose), seen.offsets);
  double least = kNothing;
  for (const KeypointEvidence::Person& person : seen.people) {
    const double distance = median_distance(person, predicted);
    if (!(distance >= least)) least = std::isnan(distance) ? least : distance;
  }
  return shrink * least;
}

std::vector<std::pair<std::string, std::vector<double>>> keypoint_residuals(
    const TrackedFrames& frames, const Scene& scene, const Config& config) {
  std::vector<int> shrinks;
  for (const SceneCamera& camera : scene.cameras)
    shrinks.push_back(working_scale(scene, camera.camera, config).shrink);
  const Body body = make_body(scene.subject, config.body);
  std::vector<std::vector<double>> values(scene.cameras.size());
  for (const FrameRecord& record : frames.records)
    for (size_t c = 0; c < values.size(); ++c)
      values[c].push_back(record.keypoints.empty() || !record.tracked
                              ? kNothing
                              : keypoint_residual(record.keypoints[c], scene.cameras[c].camera,
                                                  shrinks[c], body, record.estimate.pose));
  std::vector<std::pair<std::string, std::vector<double>>> out;
  for (size_t c = 0; c < values.size(); ++c)
    if (any(values[c]))
      out.emplace_back("keypoint_residual_px." + scene.cameras[c].name, std::move(values[c]));
  return out;
}

KeypointUse total_use(std::span<const KeypointTerm::State> cameras) {
  KeypointUse sum;
  for (const KeypointTerm::State& camera : cameras) {
    sum.frames += camera.use.frames;
    sum.matched += camera.use.matched;
    sum.legs_flipped += camera.use.legs_flipped;
  }
  return sum;
}

std::vector<std::pair<std::string, double>> keypoint_numbers(
    std::span<const KeypointTerm::State> cameras) {
  const KeypointUse use = total_use(cameras);
  if (use.frames == 0) return {};
  double scale = 0;
  for (const KeypointTerm::State& camera : cameras)
    for (const PointKind kind : {PointKind::kHip, PointKind::kKnee, PointKind::kAnkle})
      scale += camera.errors.scale[static_cast<size_t>(kind)] / 3 / double(cameras.size());
  const auto frames = double(use.frames), matched = double(use.matched);
  std::vector<std::pair<std::string, double>> out{{"keypoint_frames", frames},
                                                  {"keypoint_used_share", matched / frames},
                                                  {"keypoint_scale", scale}};
  if (matched > 0) out.emplace_back("keypoint_flip_share", double(use.legs_flipped) / matched);
  return out;
}

void draw_keypoints(const KeypointEvidence& seen, int shrink, const OverlayView& view,
                    Image& image) {
  const double arm_px = 3.0 * line_thickness(image);
  for (const KeypointEvidence::Person& person : seen.people)
    for (size_t i = 0; i < kBodyPoints; ++i)
      if (person[i].precision > 0)
        draw_cross(image, in_view(view, picture_px(person[i].px, shrink)), colour_of(i), arm_px);
}

}  // namespace jobs
}  // namespace walktrack
