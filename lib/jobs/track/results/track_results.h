// What tracking leaves behind: tables of joints and angles, the record of the run.
#pragma once

#include <string>
#include <vector>

#include "io/archive/frame_file.h"
#include "io/archive/result_folder.h"
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
// Motions that the particles hold for possible: one of each place in the order in which resampling
// keeps families of particles together, so that a member is mostly one family's history.
// Members are read from the frames when they are asked for.
Ensemble ensemble_of(const TrackedFrames& frames);
// When the walkers' weight changed onto a foot.
std::vector<SupportTransfer> support_transfers_of(const TrackedFrames& frames);

// The result folder of a track: what is read, and every file that may be written.
Outputs track_outputs(const TrackJob& job);

// The scene with what was found out about its subject; weights that it does not give go with the
// square of the height.
Scene with_stature(const Scene& scene, const std::optional<Stature>& stature);

struct WrittenTables {
  std::string digest;  // of joints.csv and uncertainty.csv
  KineticsTotals totals;
  WalkSummary walk;
};
// `model_error` multiplies what gait's bands hold beyond the particles' spread.
AnalysedMotion analysed_motion(const TrackedFrames& frames, const Scene& scene, double model_error);
WrittenTables write_tables(const AnalysedMotion& analysed, const JointUncertainty& uncertainty,
                           const KineticsConfig& config, const ResultFolder& folder);

// Feet that took over from each other: how often the likelier stance side changed while walking.
int foot_changes(const TrackedFrames& frames);

}  // namespace jobs
}  // namespace walktrack
