// Implausible camera poses and the change of the file that would correct them: every common mistake
// is undone on trial, and the change that makes the camera plausible is proposed.
#pragma once

#include "io/scene/scene.h"
#include "jobs/check/check_report.h"

namespace walktrack {
inline namespace jobs {

// Finds implausible camera poses: below the ground, upside down, too far away, without a person in
// view, or without ground in common with the other cameras; and the change of their file that would
// correct them.
void check_poses(const Scene& scene, CheckReport& report);

}  // namespace jobs
}  // namespace walktrack
