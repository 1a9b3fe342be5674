// Checks the videos of a scene: sizes, rates, lengths and time stamps, and whether frames can be
// decoded.
#pragma once

#include "core/job_control.h"
#include "io/scene/scene.h"
#include "jobs/check/check_report.h"

namespace walktrack {
inline namespace jobs {

// Checks frame sizes, rates, lengths, time stamps and rotations of the videos without decoding
// them. Returns false if frames cannot be compared with the calibrations.
bool check_videos(const Scene& scene, const JobControl& control, CheckReport& report);

// Finds frames that cannot be decoded.
void check_decoding(const Scene& scene, const JobControl& control, CheckReport& report);

}  // namespace jobs
}  // namespace walktrack
