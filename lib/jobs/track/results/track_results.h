// What tracking leaves behind: tables of joints and angles, the record of the run.
#pragma once

#include <string>
#include <vector>

#include "io/archive/frame_file.h"
#include "io/archive/result_folder.h"
#include "io/scene/subject_file.h"
#include "jobs/track/results/motion_tables.h"
#include "jobs/track/track.h"
#include "metrics/statistics/coverage.h"
#include "tracker/tracker.h"

namespace walktrack {
inline namespace jobs {

// The frames of a track.
struct TrackedFrames {
  double frame_rate = 30;  // Hz
  FrameFile records;
};

Motion motion_of(const TrackedFrames& frames);
JointUncertainty uncertainty_of(const TrackedFrames& frames);
// The sample motions of the track. Members are read from the frames when they are requested.
Ensemble ensemble_of(const TrackedFrames& frames);
// When the walkers' weight changed onto a foot.
std::vector<SupportTransfer> support_transfers_of(const TrackedFrames& frames);

// The result folder of a track: what is read, and every file that may be written.
Outputs track_outputs(const TrackJob& job);

// The scene with what was estimated of its subject; a mass that it does not state is in proportion
// to the square of the height.
Scene with_estimates(const Scene& scene, const SubjectEstimates& estimates);

// What is known of the scene's subject after the track, for other scenes of the same person.
StatedSubject known_subject(const Scene& scene, const SubjectEstimates& estimates);

struct WrittenTables {
  std::string digest;  // of joints.csv and uncertainty.csv
  KineticsTotals totals;
  WalkSummary walk;
};
// `model_error`: factor on the errors that gait's bands have beyond the samples.
AnalysedMotion analysed_motion(const TrackedFrames& frames, const Scene& scene, double model_error);
WrittenTables write_tables(const AnalysedMotion& analysed, const JointUncertainty& uncertainty,
                           const KineticsConfig& config, const ResultFolder& folder);

// How often the likelier supporting side changed while walking.
int foot_changes(const TrackedFrames& frames);

}  // namespace jobs
}  // namespace walktrack
