// `walktrack init` for two videos: makes a scene that can be tracked from one walk of a subject of
// known height that two cameras recorded at the same time.
//
// Both cameras stand still. The pose network detects the subject's joints in both videos. Their
// rays have to meet, which determines the relative pose of the cameras, their focal lengths and the
// lag between their clocks (observation/two_views/two_views.h). All lengths are metric, and as
// accurate as the stated height and the lenses.
#pragma once

#include <array>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "core/job_control.h"
#include "jobs/check/check.h"
#include "observation/two_views/two_views.h"

namespace walktrack {
inline namespace jobs {

struct InitPairJob {
  std::array<std::filesystem::path, 2> videos;
  double height = 0;                               // of the subject, m
  std::vector<std::filesystem::path> backgrounds;  // frames of the empty scene, of both cameras or
                                                   // of none
  std::optional<double> mass;                      // kg
  std::array<std::optional<double>, 2> fov_deg;    // along the longer side of the image
  std::optional<double> frame_rate;                // Hz, of images
  std::filesystem::path output;
  bool overwrite = false;
  std::vector<std::string> command_line;
};

struct InitPairOutcome {
  TwoViews views;
  std::array<Measured, 2> fov_deg;
  std::array<std::string, 2> fov_from;  // in words
  size_t moments = 0;                   // of the walk that both recorded
  int start_frame = 0;                  // of the camera that began earlier; 0 = they began together
  size_t early = 0;                     // index of that camera
  CheckReport check;
  std::filesystem::path scene, picture;
};

// Errors of seen_person.h and two_views.h.
InitPairOutcome init_pair(const InitPairJob& job, const JobControl& control);

// A description of the result with its bands and possible uses.
std::string init_pair_text(const InitPairOutcome& outcome);

}  // namespace jobs
}  // namespace walktrack
