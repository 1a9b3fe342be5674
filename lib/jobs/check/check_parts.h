// The parts of `walktrack check`. Each checks one property and adds its findings.
#pragma once

#include <filesystem>
#include <optional>
#include <vector>

#include <Eigen/Core>

#include "io/archive/result_folder.h"
#include "jobs/check/check.h"
#include "observation/figures/moving_figure.h"

namespace walktrack {
inline namespace jobs {

// Cameras that cannot be: underground, upside down, too far, seeing nobody, or none of the others'
// ground; and which single change of their file would put them right.
void check_poses(const Scene& scene, CheckReport& report);

// Frame sizes, rates, lengths, time stamps and turns of the videos, without decoding them. False if
// frames cannot be compared with the calibrations.
bool check_videos(const Scene& scene, const JobControl& control, CheckReport& report);

// Keypoint files: InputErrors for those that cannot be used, notes about what is odd.
void check_keypoints(const Scene& scene, CheckReport& report);

// Frames that cannot be decoded.
void check_decoding(const Scene& scene, const JobControl& control, CheckReport& report);

// The figures' paths through the videos, by camera, from the first frame on, at most
// kMostSyncFrames.
struct SeenFigures {
  double frame_rate = 0;  // of the scene, Hz
  std::vector<FigurePath> paths;
};
SeenFigures figures_in(const Scene& scene, const JobControl& control);
inline constexpr int kMostSyncFrames = 300;

void check_steps(const Scene& scene, const JobControl& control, CheckReport& report);

// The folder of the pictures.
Outputs check_outputs(const Scene& scene, const std::filesystem::path& folder);

// Ground grid, world axes and a standing figure in the first frame of each camera.
void write_check_pictures(const Scene& scene, const CheckReport& report,
                          const std::filesystem::path& folder);

}  // namespace jobs
}  // namespace walktrack
