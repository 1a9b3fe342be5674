// The parts of `walktrack check`. Each looks at one thing and adds its findings.
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

// How two cameras are out of step, found from the heights at which the figure's outline ends: a
// plane through both cameras that touches it in one image touches it in the other at that instant
// (epipolar tangents; Sinha & Pollefeys 2004). Frames are the scene's.
struct PairLag {
  int before = 0, after = 0;  // frames that the second camera shows things later than the first
  int changes_at = 0;         // frame from which `after` holds; equal lags: no change
  double sd = 0;              // frames, of `after` where nothing changes
  // The time of one or more steps: a camera that stands a step further along the way than its
  // calibration says sees the same. Or the time of a step is not known and this is no shorter.
  bool may_be_steps = false;
};
// nullopt if the cameras see too little to tell.
std::optional<PairLag> find_pair_lag(const std::vector<Camera>& cameras,
                                     const std::vector<FigurePath>& paths, double frame_rate);

void check_steps(const Scene& scene, const JobControl& control, CheckReport& report);

// The folder of the pictures.
Outputs check_outputs(const Scene& scene, const std::filesystem::path& folder);

// Ground grid, world axes and a standing figure in the first frame of each camera.
void write_check_pictures(const Scene& scene, const CheckReport& report,
                          const std::filesystem::path& folder);

}  // namespace jobs
}  // namespace walktrack
