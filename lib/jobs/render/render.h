// `walktrack render`: converts a motion to a scene folder that `track` reads, with its truth:
//   scene.yaml, <camera>.mp4, <camera>.yaml, <camera>_background.mp4 (with `images`, folders of
//   %06d.png in place of .mp4), <camera>_keypoints (on request; jobs/render/render_keypoints.h),
//   truth.csv (joints), angles.csv (io/tables/angles_file.h, without bands), events.csv,
//   kinetics.csv if the motion has forces (io/tables/kinetics_file.h), and on request
//   labels/<camera>/%06d.png (0 = nobody, 1 + part + 100 person), flow/<camera>/%06d.flo
//   (Middlebury), depth/<camera>/%06d.pfm (m).
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include "core/job_control.h"
#include "io/scene/render_file.h"
#include "synth/recording/render_options.h"

namespace walktrack {
inline namespace jobs {

struct RenderJob {
  FilmedWalker walker;
  std::optional<GaitWalk> gait;  // replaces the subject's motion
  RenderOptions options;
  std::vector<std::filesystem::path> inputs;  // files from which motion and options were read
  std::filesystem::path output;
  bool overwrite = false;
  int threads = 0;  // 0 = all that the process may use
};

// scene.yaml is written last: a folder that contains it is complete. UsageError if it exists
// already and may not be overwritten, or was not written by render_scene(). Returns the number of
// frames rendered, of all cameras together.
size_t render_scene(const RenderJob& job, const JobControl& control);

}  // namespace jobs
}  // namespace walktrack
