// `walktrack prior`: builds the table of gaits, and describes the content of a table.
#pragma once

#include <filesystem>

#include "core/job_control.h"
#include "gait/prior/build_prior.h"

namespace walktrack {
inline namespace jobs {

struct PriorJob {
  PriorGrid grid;
  std::filesystem::path output;   // the table; unfinished work is in output + ".part"
  std::filesystem::path earlier;  // a table whose valid gaits are kept; may be empty
  bool overwrite = false;
  int threads = 0;  // 0 = all that the process may use
};

// Resumes from output + ".part" if it exists. UsageError if the table exists already and may not be
// overwritten. Returns false if it was interrupted; the part then remains.
bool build_prior(const PriorJob& job, const JobControl& control);

// The anthropomorphic walker's table, on the grid's slopes. It takes less than a second and is not
// resumed.
void build_straight_prior(const PriorJob& job, const JobControl& control);

struct PriorReportJob {
  std::filesystem::path prior;   // a table; empty = the one of this program
  std::filesystem::path output;  // a folder
  double height = 1.75;          // m, of the person for whom numbers are shown
  double mass = 70;              // kg
  size_t walkers = 1000;         // samples for each row of survival.csv
  uint64_t seed = 1;
  bool overwrite = false;
  int threads = 0;
};

// Writes gaits.csv (every node), survival.csv (shares of sampled walkers that keep walking),
// cheapest.csv (the step length and speed of least cost), cost.svg, cheapest_step.svg and
// strips.svg. gaits.csv is written last: a folder that contains it is complete.
void report_prior(const PriorReportJob& job, const JobControl& control);

// Writes gaits.csv, survival.csv and cost.svg of the anthropomorphic walker's table.
void report_straight_prior(const PriorReportJob& job, const JobControl& control);

}  // namespace jobs
}  // namespace walktrack
