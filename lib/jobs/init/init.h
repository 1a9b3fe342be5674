// `walktrack init`: makes a scene that can be tracked from a video of a subject of known height who
// walks past a camera, without a calibration board or measured points.
//
// The camera stands still and nearly level, and sees the walk from the side. Scale and floor follow
// from the positions of head and feet during the walk (camera/view_from_walker.h). The focal length
// follows from a stated field of view, otherwise from the metadata on the lens or the telephone,
// otherwise it has a usual value. Speeds and steps across the image depend on the scale only. The
// distance from the camera and all lengths across the walk are as uncertain as the focal length and
// cannot be used, unless lengths on the floor are known, such as the sides and diagonals of a tile.
//
// For two videos of one walk, from cameras that stand still, see jobs/init/init_pair.h.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "camera/view_from_walker.h"
#include "core/job_control.h"
#include "jobs/check/check.h"

namespace walktrack {
inline namespace jobs {

struct InitJob {
  std::filesystem::path video;
  double height = 0;                 // of the subject, m
  std::filesystem::path background;  // frames of the empty scene; empty = none
  std::optional<double> mass;        // kg
  std::optional<double> fov_deg;     // along the longer side of the image
  std::optional<double> tilt_deg;    // how far the camera looks down, if that was measured
  std::vector<FloorLength> floor;    // known lengths on the floor
  std::optional<double> frame_rate;  // Hz, of images
  int threads = 0;                   // 0 = as many as there are
  std::filesystem::path output;
  bool overwrite = false;
  std::vector<std::string> command_line;
};

struct InitOutcome {
  WalkerView view;
  double fov_deg = 0, fov_sd_deg = 0;
  std::string fov_from;              // in words
  size_t positions = 0;              // of the subject, each averaged over a stride
  double nearest = 0, farthest = 0;  // distances of these positions from the camera, m
  CheckReport check;
  std::filesystem::path scene, picture;
};

// InputError if nobody walks through the image, or if nobody is completely visible.
InitOutcome init_scene(const InitJob& job, const JobControl& control);

// A description of the result with its bands and possible uses.
std::string init_text(const InitOutcome& outcome);

}  // namespace jobs
}  // namespace walktrack
