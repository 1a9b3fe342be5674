// The contents of run.json for a run of `track`.
#pragma once

#include <string>

#include "io/archive/run_record.h"
#include "jobs/track/report/track_quality.h"
#include "jobs/track/results/track_results.h"
#include "jobs/track/stopwatch.h"
#include "jobs/track/track.h"
#include "jobs/track/track_run.h"

namespace walktrack {
inline namespace jobs {

// Counts over the frames of a video: `first` is -1 if nobody was tracked; frames after it without a
// track are lost; particles that fell and that diverged.
struct FrameCounts {
  int tracked = 0, first = -1, lost = 0, fallen = 0, diverged = 0;
};
FrameCounts frame_counts(const TrackedFrames& frames);

// What was estimated of the subject because the scene does not state it, a sentence each.
std::vector<std::string> subject_notes(const Scene& scene, const TrackRun& run);

RunRecord record_of(const TrackJob& job, const Origin& inputs, const TrackRun& run,
                    const TrackedFrames& frames, const TrackOutcome& outcome,
                    const Quality& quality, const WrittenTables& tables, const Elapsed& spent);

}  // namespace jobs
}  // namespace walktrack
