// `walktrack check`: checks a scene. It reports where every camera stands and what it sees, and
// finds common mistakes in calibrations and recordings: a camera below the ground or upside down,
// millimetres instead of metres, a transposed or inverted pose, a wrong image size, unequal or
// variable frame rates, rotated phone video, cameras that are not synchronous. It gives advice for
// every mistake.
//
// The fast checks also precede tracking: calibrations, sizes, rates and time stamps without
// decoding a frame, and for two or more cameras the first frames, to test whether they are
// synchronous.
//
// Mistakes that make a scene unreadable (a matrix that is not a rotation, a mirrored one, unknown
// keys) are InputErrors of the readers, with their place and advice.
#pragma once

#include <filesystem>

#include "core/job_control.h"
#include "io/scene/scene.h"
#include "jobs/check/check_report.h"

namespace walktrack {
inline namespace jobs {

struct CheckJob {
  std::filesystem::path scene;
  std::filesystem::path pictures;  // folder for check_<camera>.png; empty = none
};

CheckReport check_scene(const CheckJob& job, const JobControl& control);

// The checks with which `track` begins.
CheckReport look_at_scene(const Scene& scene, const JobControl& control);

}  // namespace jobs
}  // namespace walktrack
