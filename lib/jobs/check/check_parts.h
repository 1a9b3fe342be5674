// The parts of `walktrack check`. Each looks at one thing and adds its findings.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "io/archive/result_folder.h"
#include "jobs/check/check.h"

namespace walktrack {

// Cameras that cannot be: underground, upside down, too far, seeing nobody, or none of the others'
// ground; and which single change of their file would put them right.
void check_poses(const Scene& scene, CheckReport& report);

// Frame sizes, rates, lengths, time stamps and turns of the videos. False if frames cannot be
// compared with the calibrations.
bool check_videos(const Scene& scene, const JobControl& control, CheckReport& report);

// Keypoint files: InputErrors for those that cannot be used, notes about what is odd.
void check_keypoints(const Scene& scene, CheckReport& report);

// Where the moving figure of one frame is; nullopt when nothing or too much moves.
using FigurePath = std::vector<std::optional<Eigen::Vector2d>>;  // px of the full image

// The figure's path through one video, from its start frame on, at most kMostSyncFrames.
FigurePath figure_path(const SceneCamera& camera);
inline constexpr int kMostSyncFrames = 600;

// Cameras out of step, found from three or more paths: the vertical planes through the figure, seen
// by all cameras at one instant, meet in one line. Every single camera that could be shifted to
// make them meet is listed, the best first; with three cameras there may be several.
// Empty if the cameras agree or nothing can be said.
struct OutOfStep {
  size_t camera;
  int frames_late;               // positive: it shows things later than the others
  double gap_before, gap_after;  // m, how far the planes miss each other
};
std::vector<OutOfStep> find_out_of_step(const std::vector<Camera>& cameras,
                                        const std::vector<FigurePath>& paths);

void check_steps(const Scene& scene, const JobControl& control, CheckReport& report);

// The folder of the pictures.
Outputs check_outputs(const Scene& scene, const std::filesystem::path& folder);

// Ground grid, world axes and a standing figure in the first frame of each camera.
void write_check_pictures(const Scene& scene, const CheckReport& report,
                          const std::filesystem::path& folder);

}  // namespace walktrack
