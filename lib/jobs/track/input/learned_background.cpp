#include "jobs/track/input/learned_background.h"

#include <algorithm>
#include <vector>

#include "core/parallel_for.h"
#include "io/archive/files.h"
#include "io/video/video.h"
#include "jobs/track/input/person_finder.h"
#include "jobs/track/input/pose_model.h"
#include "jobs/track/track_setup.h"
#include "observation/background/background_sampler.h"
#include "observation/background/people_mask.h"
#include "observation/image.h"
#include "observation/image_threads.h"
#include "observation/pose_net/pose_net.h"

namespace walktrack {
inline namespace jobs {

namespace {

// A person who is found late is followed back to earlier frames.
std::vector<DetectedPeople> people_in(const BackgroundSampler& frames, PoseNet& net,
                                      double person_px, const JobControl& control) {
  const auto count = static_cast<size_t>(frames.frames());
  std::vector<DetectedPeople> people(count);
  const Image first = frames.frame(0);
  PersonFinder finder(first.cols, first.rows, person_px);
  const auto look = [&](size_t frame) {
    return finder.look(net, frames.frame(static_cast<int>(frame)), static_cast<int>(frame));
  };
  for (size_t f = 0; f < count && !control.stopping(); ++f) {
    people[f] = look(f);
    control.progress("looking for people in the background", f, count);
  }
  for (size_t f = count; f-- > 0 && !control.stopping();) {
    if (f + 1 < count && people[f].size() >= people[f + 1].size()) continue;
    DetectedPeople again = look(f);
    if (again.size() > people[f].size()) people[f] = std::move(again);
  }
  return people;
}

void hide_people(BackgroundSampler& frames, const KeypointConfig& config, double person_px,
                 const JobControl& control) {
  const auto file = pose_model_file(config.model);
  if (!has_pose_net() || !file) return;
  const OneImageThread one_thread;
  PoseNet net(read_text_file(*file, kMaxModelBytes), file->string());
  const std::vector<DetectedPeople> people = people_in(frames, net, person_px, control);
  for (int f = 0; f < frames.frames(); ++f)
    frames.hide(f, people_mask(people[static_cast<size_t>(f)], frames.frame(f).size()));
}

}  // namespace

bool learns_from_video(const SceneCamera& camera) {
  return camera.background.empty() && !camera.video.empty();
}

bool leaves_people_out(const Scene& scene, const Config& config) {
  const ObservationConfig& observation = config.observation;
  if (!observation.background.enabled) return false;
  const TermSetting setting = observation.background.without_people;
  if (setting != TermSetting::kAuto) return setting == TermSetting::kOn;
  return observation.keypoints.enabled != TermSetting::kOff && has_pose_net() &&
         pose_model_file(observation.keypoints.model) &&
         std::any_of(scene.cameras.begin(), scene.cameras.end(), [&](const SceneCamera& camera) {
           return learns_from_video(camera) &&
                  working_scale(scene, camera.camera, config).person_px >= kLeastPerson_px;
         });
}

BackgroundModel learned_background(const SceneCamera& camera, const Config& config,
                                   const WorkingScale& scale, const JobControl& control) {
  const BackgroundConfig& background = config.observation.background;
  const bool from_video = learns_from_video(camera);
  FrameSource source(from_video ? camera.video : camera.background,
                     PixelSize(camera.camera.width_px, camera.camera.height_px));
  BackgroundSampler sampler(background);
  const auto total = static_cast<size_t>(source.facts().frame_count);
  Image frame;
  for (size_t done = 0; source.advance(); ++done) {
    if (sampler.takes_next()) {
      source.picture(scale.shrink, frame);
      sampler.take(frame);
    }
    control.progress("learning the background", done, total);
    if (control.stopping()) break;  // not before the first frame, without which there is no model
  }
  if (from_video && background.without_people == TermSetting::kOn)
    hide_people(sampler, config.observation.keypoints, scale.person_px / scale.shrink, control);
  return sampler.model(thread_count(config.threads));
}

}  // namespace jobs
}  // namespace walktrack
