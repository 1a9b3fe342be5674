#include "jobs/check/check_parts.h"

namespace walktrack {
inline namespace jobs {

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

}  // namespace jobs
}  // namespace walktrack
