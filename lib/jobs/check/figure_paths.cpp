// The paths of moving figures in all videos of a scene.
#include <vector>

#include "io/video/scene_video.h"
#include "jobs/check/check_parts.h"
#include "observation/image.h"

namespace walktrack {
inline namespace jobs {

SeenFigures figures_in(const Scene& scene, const JobControl& control) {
  SceneVideo video(scene);
  SeenFigures out{video.frame_rate(), {}};
  std::vector<MovingFigures> cameras;
  for (const SceneCamera& each : scene.cameras)
    cameras.emplace_back(each.camera.width_px, each.camera.height_px);
  SceneFrames images;
  for (int n = 0; n < kMostSyncFrames && !control.stopping() && video.read(images); ++n)
    for (size_t i = 0; i < cameras.size(); ++i)
      cameras[i].add(images.fresh[i] ? images.images[i] : Image());
  for (const MovingFigures& camera : cameras) out.paths.push_back(camera.path());
  return out;
}

}  // namespace jobs
}  // namespace walktrack
