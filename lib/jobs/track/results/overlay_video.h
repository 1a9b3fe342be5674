// overlay_<camera>.mp4: the video with the tracked figure and the particles' spread in it, so large
// as `overlay` of the configuration says.
//
// The reported pose follows from all frames, so the video is read a second time. A frame is read
// and shrunk while figures are drawn into the one before and that is encoded, of several cameras at
// the same time: what is held is one picture of a camera as it was recorded, and two as they are
// shown.
#pragma once

#include <string>
#include <vector>

#include "core/job_control.h"
#include "io/archive/result_folder.h"
#include "io/drawing/report_page.h"
#include "jobs/track/results/track_results.h"

namespace walktrack {
inline namespace jobs {

std::string overlay_name(const SceneCamera& camera);

// Writes one for each camera and marks those that the report has room for. The same bytes for any
// number of threads. std::runtime_error if one cannot be written: then none is left half written.
std::vector<ReportClip> write_overlays(const TrackJob& job, const TrackedFrames& frames,
                                       const ResultFolder& folder, int threads,
                                       const JobControl& control);

}  // namespace jobs
}  // namespace walktrack
