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

// The estimated size of the subject, if the scene does not state it, as a sentence.
std::string size_note(const Scene& scene, const Stature& stature);

RunRecord record_of(const TrackJob& job, const Origin& inputs, const TrackRun& run,
                    const TrackedFrames& frames, const TrackOutcome& outcome,
                    const Quality& quality, const WrittenTables& tables, const Elapsed& spent);

}  // namespace jobs
}  // namespace walktrack
