#include "jobs/track/input/learned_background.h"

#include <algorithm>
#include <cmath>
#include <exception>
#include <optional>
#include <vector>

#include <fmt/format.h>

#include "core/parallel_for.h"
#include "io/archive/files.h"
#include "io/video/video.h"
#include "jobs/track/input/person_finder.h"
#include "jobs/track/input/pose_model.h"
#include "jobs/track/track_setup.h"
#include "observation/background/background_sampler.h"
#include "observation/background/moved_things.h"
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
  PoseNet net(read_text_file(*file, kMaxModelBytes), file->string());
  const std::vector<DetectedPeople> people = people_in(frames, net, person_px, control);
  for (int f = 0; f < frames.frames(); ++f)
    frames.hide(f, people_mask(people[static_cast<size_t>(f)], frames.frame(f).size()));
}

int frames_between(const FrameSource& video, double seconds) {
  constexpr double kUsualRate = 30;
  const double rate = video.facts().frame_rate > 0 ? video.facts().frame_rate : kUsualRate;
  return std::max(1, static_cast<int>(std::lround(seconds * rate)));
}

// By hand. Time between the frames of the video that show how bright and dark people are, s, and
// their number.
constexpr double kBetweenShown = 0.5;
constexpr int kMostShown = 20;

// Shows frames of the video for as long as it seems to have little contrast.
void show_video(const SceneCamera& camera, int first_frame, const WorkingScale& scale,
                const JobControl& control, BackgroundSampler& sampler) {
  FrameSource video(camera.video, PixelSize(camera.camera.width_px, camera.camera.height_px));
  bool more = video.skip(camera.start_frame + first_frame);
  const int step = frames_between(video, kBetweenShown);
  Image frame;
  for (int shown = 0; more && shown < kMostShown && !control.stopping() && video.advance();
       ++shown) {
    video.picture(scale.shrink, frame);
    sampler.show(frame);
    more = sampler.has_little_contrast() && video.skip(step - 1);
  }
}

// By hand. Time between the frames of the video that are compared with the empty scene, s; side of
// the smallest thing that is found, as a share of the subject's height.
constexpr double kBetweenCompared = 0.5;
constexpr double kSmallestThing = 0.05;

// Compares the video with the empty scene for as long as something may never be as in that.
BackgroundModel with_moved_things(const BackgroundModel& empty_scene, const SceneCamera& camera,
                                  int first_frame, const Config& config, const WorkingScale& scale,
                                  const JobControl& control) {
  FrameSource video(camera.video, PixelSize(camera.camera.width_px, camera.camera.height_px));
  if (!video.skip(camera.start_frame + first_frame)) return empty_scene;
  const auto step = static_cast<size_t>(frames_between(video, kBetweenCompared));
  const auto total = static_cast<size_t>(video.facts().frame_count);
  MovedThings things(config.observation.background, empty_scene,
                     kSmallestThing * scale.person_px / scale.shrink, thread_count(config.threads));
  Image frame;
  for (size_t number = 0; !control.stopping() && video.advance(); ++number) {
    control.progress("comparing the video with the empty scene", number, total);
    if (number % step != 0) continue;
    video.picture(scale.shrink, frame);
    things.compare(frame);
    if (!things.possible()) break;
  }
  return things.corrected();
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

BackgroundModel learned_background(const SceneCamera& camera, int first_frame, const Config& config,
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
  show_video(camera, first_frame, scale, control, sampler);
  BackgroundModel model = sampler.model(thread_count(config.threads));
  if (from_video) return model;
  return with_moved_things(model, camera, first_frame, config, scale, control);
}

std::vector<std::optional<BackgroundModel>> learned_backgrounds(const Scene& scene,
                                                                const Config& config,
                                                                const JobControl& control) {
  const size_t count = scene.cameras.size();
  std::vector<std::optional<BackgroundModel>> models(count);
  std::vector<std::exception_ptr> errors(count);
  const OneImageThread one_thread;  // so that the network's sums are the same
  parallel_for(count, thread_count(config.threads), [&](size_t c) {
    const SceneCamera& camera = scene.cameras[c];
    if (camera.video.empty()) return;
    JobControl own = control;
    if (c > 0) own.report = {};  // the first camera's progress stands for all
    try {
      models[c] = learned_background(camera, scene.first_frame, config,
                                     working_scale(scene, camera.camera, config), own);
    } catch (...) {
      errors[c] = std::current_exception();
    }
  });
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
  return models;
}

std::string moved_things_text(double share) {
  return fmt::format(
      "{:.2g} % of the picture never looks like the images of the empty scene: something was "
      "moved, or the light is another one; there the background is learned from the video",
      100 * share);
}

}  // namespace jobs
}  // namespace walktrack
