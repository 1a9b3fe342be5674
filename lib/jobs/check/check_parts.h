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

// Finds implausible camera poses: below the ground, upside down, too far away, without a person in
// view, or without ground in common with the other cameras; and the change of their file that would
// correct them.
void check_poses(const Scene& scene, CheckReport& report);

// Checks frame sizes, rates, lengths, time stamps and rotations of the videos without decoding
// them. Returns false if frames cannot be compared with the calibrations.
bool check_videos(const Scene& scene, const JobControl& control, CheckReport& report);

// Checks keypoint files: InputErrors for those that cannot be used, notes on irregularities.
void check_keypoints(const Scene& scene, CheckReport& report);

// Finds frames that cannot be decoded.
void check_decoding(const Scene& scene, const JobControl& control, CheckReport& report);

// The paths of the moving figures, by camera, from the first frame on, at most kMostSyncFrames.
struct SeenFigures {
  double frame_rate = 0;  // of the scene, Hz
  std::vector<FigurePath> paths;
};
SeenFigures figures_in(const Scene& scene, const JobControl& control);
inline constexpr int kMostSyncFrames = 300;

void check_steps(const Scene& scene, const JobControl& control, CheckReport& report);

// The folder of the images.
Outputs check_outputs(const Scene& scene, const std::filesystem::path& folder);

// Draws the ground grid, the world's axes and a standing figure into the first frame of each
// camera.
void write_check_pictures(const Scene& scene, const CheckReport& report,
                          const std::filesystem::path& folder);

}  // namespace jobs
}  // namespace walktrack
