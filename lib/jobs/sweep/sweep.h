// `walktrack sweep`: measures the accuracy of tracking a scene against its time. The scene is
// tracked with every setting of a grid and several seeds; the files are
//   sweep.csv, sweep.json, sweep.md   one row for each setting, and which one to use
//   sweep.svg                         error against time, the settings that nothing beats joined
//   runs/<setting>/seed_<n>/          every run's own result folder
// A run whose folder is complete, of the same scene, configuration and program, is not repeated: a
// sweep that was interrupted continues, and one with more values or seeds measures only these.
// Seeds are the outer loop, so that a change of the machine's load affects all settings equally,
// and the runs before an interruption cover all settings. Errors depend only on inputs and seeds;
// times do not.
#pragma once

#include <vector>

#include "core/job_control.h"
#include "jobs/sweep/sweep_report.h"

namespace walktrack {
inline namespace jobs {

// Throws UsageError or InputError for what cannot be started, InputError for a video that ends
// early.
SweepReport run_sweep(const SweepJob& job, const JobControl& control);

// Computes means, deviations and the front from the runs of the rows.
void summarise_sweep(std::vector<SweepRow>& rows, double most_lost_share);

}  // namespace jobs
}  // namespace walktrack
