#include "jobs/check/check.h"

#include <fmt/format.h>

#include "io/archive/result_folder.h"
#include "jobs/check/check_pictures.h"
#include "jobs/check/check_poses.h"
#include "jobs/check/check_sync.h"
#include "jobs/check/check_videos.h"
#include "jobs/track/input/learned_background.h"
#include "jobs/track/track_setup.h"

namespace walktrack {
inline namespace jobs {

namespace {

// Checks keypoint files: InputErrors for those that cannot be used, notes on irregularities.
void check_keypoints(const Scene& scene, CheckReport& report) {
  for (size_t i = 0; i < scene.cameras.size(); ++i) {
    const SceneCamera& camera = scene.cameras[i];
    if (camera.keypoints.path.empty()) continue;
    const KeypointFrames frames = read_keypoints(camera.keypoints);
    check_image_size(frames, camera.keypoints, camera.camera);
    for (const std::string& note : keypoint_notes(frames, report.cameras[i].video.frame_count))
      report.findings.push_back({camera.name, false, "keypoints: " + note, ""});
  }
}

// Remarks where videos show other things than the images of their empty scenes.
void check_backgrounds(const Scene& scene, const JobControl& control, CheckReport& report) {
  const Config config;
  for (const SceneCamera& camera : scene.cameras) {
    if (camera.background.empty() || camera.video.empty()) continue;
    const BackgroundModel model = learned_background(
        camera, scene.first_frame, config, working_scale(scene, camera.camera, config), control);
    if (model.from_video > 0)
      report.findings.push_back({camera.name, false, moved_things_text(model.from_video),
                                 "none is needed if this is little; otherwise a new picture of the "
                                 "empty scene, by the same camera at the same place"});
  }
}

}  // namespace

CheckReport look_at_scene(const Scene& scene, const JobControl& control) {
  CheckReport report;
  for (const SceneCamera& camera : scene.cameras) {
    report.cameras.push_back(
        {camera.name, inspect_camera(camera.camera, scene.subject.height), {}});
  }
  check_poses(scene, report);
  const bool poses_can_be = !report.failed();
  // Tests on the images mean nothing if calibrations or sizes are wrong.
  if (check_videos(scene, control, report) && poses_can_be) check_steps(scene, control, report);
  check_keypoints(scene, report);
  return report;
}

CheckReport check_scene(const CheckJob& job, const JobControl& control) {
  const Scene scene = read_scene(job.scene);
  if (!job.pictures.empty()) refuse_what_is_not_ours(check_outputs(scene, job.pictures));
  CheckReport report = look_at_scene(scene, control);
  check_decoding(scene, control, report);
  if (!report.failed()) check_backgrounds(scene, control, report);
  if (!scene.height_given && !scene.height_sd)
    report.findings.push_back(
        {"", false,
         fmt::format("the scene does not say how tall the subject is: here {:g} m, in `track` what "
                     "the images say",
                     scene.subject.height),
         "where the height is known, subject: {height: METRES}"});
  if (!job.pictures.empty()) write_check_pictures(scene, report, job.pictures);
  return report;
}

}  // namespace jobs
}  // namespace walktrack
