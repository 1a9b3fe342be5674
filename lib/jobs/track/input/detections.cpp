#include "jobs/track/input/detections.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/archive/files.h"
#include "jobs/track/input/learned_background.h"
#include "jobs/track/input/pose_model.h"
#include "jobs/track/track_setup.h"

namespace walktrack {
inline namespace jobs {

namespace {

// The network looks at one of so many frames, or at more of them if that is less often than this.
// Compared on rendered people and the real side view at 15 Hz (observation/reports/keypoints.md).
constexpr long kUsualFrames = 3;
constexpr double kEnoughLooks_hz = 10;
// One in so many frames that are looked at is searched for others than the followed people. By
// hand.
constexpr int kScanEvery = 3;

bool all_have_files(const Scene& scene) {
  return std::all_of(scene.cameras.begin(), scene.cameras.end(),
                     [](const SceneCamera& camera) { return !camera.keypoints.path.empty(); });
}

// A camera without a video has no images to detect people in.
bool wants_network(const SceneCamera& camera) {
  return camera.keypoints.path.empty() && !camera.video.empty();
}

KeypointFrames checked_keypoints(const SceneCamera& camera) {
  KeypointFrames frames = read_keypoints(camera.keypoints);
  check_image_size(frames, camera.keypoints, camera.camera);
  return frames;
}

[[noreturn]] void fail_without_network(const KeypointConfig& config) {
  throw UsageError(describe({"", 0, "observation.keypoints.enabled"},
                            has_pose_net() ? "no file of the model " + config.model
                                           : "a program that was built without a pose detector",
                            "off, or keypoint files for every camera"));
}

bool has_network(const KeypointConfig& config) {
  return has_pose_net() && pose_model_file(config.model);
}

// Whether there are so few cameras, and people so large in them, that the network helps.
bool network_would_tell(const Scene& scene, const Config& config) {
  return scene.cameras.size() <= cameras_in_doubt(scene) &&
         std::all_of(scene.cameras.begin(), scene.cameras.end(), [&](const SceneCamera& camera) {
           return wants_network(camera) &&
                  working_scale(scene, camera.camera, config).person_px >= kLeastPerson_px;
         });
}

std::string without_network(const KeypointConfig& keypoints) {
  return has_pose_net() ? "the network '" + keypoints.model + "' is not beside the program"
                        : "the program was built without a pose detector";
}

// "" if that is not what keeps the network from a single camera.
std::string too_small_for_network(const Scene& scene, const Config& config) {
  if (scene.cameras.size() != 1 || !wants_network(scene.cameras[0])) return "";
  const double person_px = working_scale(scene, scene.cameras[0].camera, config).person_px;
  if (person_px >= kLeastPerson_px) return "";
  return fmt::format("people are {:.0f} px high in the video, the network needs {:g} px", person_px,
                     kLeastPerson_px);
}

}  // namespace

size_t cameras_in_doubt(const Scene& scene) {
  return std::any_of(scene.cameras.begin(), scene.cameras.end(), learns_from_video) ? 2 : 1;
}

bool keypoints_wanted(const Scene& scene, const Config& config) {
  const KeypointConfig& keypoints = config.observation.keypoints;
  if (keypoints.enabled != TermSetting::kAuto) return keypoints.enabled == TermSetting::kOn;
  return all_have_files(scene) || (has_network(keypoints) && network_would_tell(scene, config));
}

std::string missing_network_note(const Scene& scene, const Config& config) {
  const KeypointConfig& keypoints = config.observation.keypoints;
  if (keypoints.enabled != TermSetting::kAuto || keypoints_wanted(scene, config)) return "";
  const std::string why = network_would_tell(scene, config) ? without_network(keypoints)
                                                            : too_small_for_network(scene, config);
  if (why.empty()) return "";
  return fmt::format(
      "without keypoints: {}; with one camera left and right then rest on outlines alone", why);
}

bool flow_wanted(const Config& config) {
  return config.observation.flow.enabled == TermSetting::kOn;
}

Config decided(const Scene& scene, const Config& config) {
  Config out = config;
  const auto setting = [](bool on) { return on ? TermSetting::kOn : TermSetting::kOff; };
  out.observation.flow.enabled = setting(flow_wanted(config));
  const bool keypoints = keypoints_wanted(scene, config);
  out.observation.keypoints.enabled = setting(keypoints);
  const EvidenceWeights weights = weights_for(scene.cameras.size(), keypoints);
  const auto by_scene = [](double& value, double chosen) {
    if (value == kWeightByScene) value = chosen;
  };
  by_scene(out.observation.outline_share, weights.outline_share);
  by_scene(out.observation.keypoints.weight, weights.point_weight);
  by_scene(out.observation.keypoints.flip, weights.flip);
  out.observation.background.without_people = setting(leaves_people_out(scene, config));
  const ParticleCounts enough = particles_for(scene.cameras.size());
  int &particles = out.tracker.filter.particles, &at_start = out.tracker.start.particles;
  if (particles == kParticlesByCameras) particles = enough.filter;
  if (at_start == kParticlesByCameras) at_start = enough.start;
  double& slide = out.quality.foot_slide;
  if (slide == kSlideByCameras) slide = allowed_slide(scene.cameras.size());
  return out;
}

int frames_between_looks(const KeypointConfig& config, double frame_rate) {
  if (config.every > 0) return config.every;
  return static_cast<int>(std::clamp(std::lround(frame_rate / kEnoughLooks_hz), 1L, kUsualFrames));
}

Detections::Detections(const Scene& scene, const KeypointConfig& config, double frame_rate,
                       std::span<const WorkingScale> scales)
    : every_(frames_between_looks(config, frame_rate)), height_(scene.subject.height) {
  std::string model;
  const auto file = pose_model_file(config.model);
  for (const SceneCamera& camera : scene.cameras) {
    const size_t c = cameras_.size();
    Viewer viewer;
    viewer.name = camera.name;
    viewer.shrink = scales[c].shrink;
    if (!camera.keypoints.path.empty()) viewer.file = checked_keypoints(camera);
    if (wants_network(camera)) {
      if (!has_pose_net() || !file) fail_without_network(config);
      if (model.empty()) model = read_text_file(*file, kMaxModelBytes);
      viewer.net.emplace(model, file->string());
      viewer.finder.emplace(camera.camera.width_px, camera.camera.height_px, scales[c].person_px,
                            kScanEvery);
      network_ = true;
    }
    cameras_.push_back(std::move(viewer));
  }
}

std::vector<std::string> Detections::notes(const std::vector<int>& video_frames) const {
  std::vector<std::string> out;
  for (size_t c = 0; c < cameras_.size(); ++c) {
    if (!cameras_[c].file) continue;
    for (const std::string& note : keypoint_notes(*cameras_[c].file, video_frames[c]))
      out.push_back(fmt::format("keypoints of camera {}: {}", cameras_[c].name, note));
  }
  return out;
}

DetectedPeople Detections::look(size_t camera, const FrameToLookAt& frame) {
  if (!on()) return {};
  Viewer& viewer = cameras_[camera];
  if (!viewer.file) return viewer.net ? seen_by_network(viewer, frame) : DetectedPeople{};
  const auto found = viewer.file->people.find(frame.source);
  return found == viewer.file->people.end() ? DetectedPeople{} : found->second;
}

DetectedPeople Detections::seen_by_network(Viewer& viewer, const FrameToLookAt& frame) const {
  if (frame.around) viewer.finder->forget();
  if (frame.scene_frame % every_ != 0) return {};
  if (frame.around && (frame.region.area.empty() || !frame.region.points)) return {};
  const auto part_of_frame = [&](const CutOut& wanted) {
    const VideoFacts& facts = frame.video.facts();
    const auto there = part_within(wanted, facts.width_px, facts.height_px);
    ImagePart part{{}, there.tl()};
    if (!there.empty()) frame.video.picture(there, 1, part.picture);
    return part;
  };
  if (!frame.around)
    return viewer.finder->look(*viewer.net, part_of_frame, frame.scene_frame / every_);
  const CutOut wanted = cut_out_around(frame.region, viewer.shrink, height_);
  return {viewer.net->detect(part_of_frame(wanted), wanted)};
}

}  // namespace jobs
}  // namespace walktrack
