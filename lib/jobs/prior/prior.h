// `walktrack prior`: builds the table of gaits, and shows what a table holds.
#pragma once

#include <filesystem>

#include "core/job_control.h"
#include "gait/prior/build_prior.h"

namespace walktrack {
inline namespace jobs {

struct PriorJob {
  PriorGrid grid;
  std::filesystem::path output;   // the table; what is done so far stands in output + ".part"
  std::filesystem::path earlier;  // a table whose valid gaits are kept; may be empty
  bool overwrite = false;
  int threads = 0;  // 0 = all that the process may use
};

// Goes on from output + ".part" where there is one. UsageError if the table is there already and
// may not be overwritten. False when it was told to stop; the part then remains.
bool build_prior(const PriorJob& job, const JobControl& control);

// The anthropomorphic walker's table, on the grid's slopes. Less than a second: nothing is resumed.
void build_straight_prior(const PriorJob& job, const JobControl& control);

struct PriorReportJob {
  std::filesystem::path prior;   // a table; empty means the one of this program
  std::filesystem::path output;  // a folder
  double height = 1.75;          // m, of the person whose numbers are shown
  double mass = 70;              // kg
  size_t walkers = 1000;         // sampled for a row of survival.csv
  uint64_t seed = 1;
  bool overwrite = false;
  int threads = 0;
};

// Writes gaits.csv (every node), survival.csv (shares of sampled walkers alive), cheapest.csv (the
// cheapest step length and speed), cost.svg, cheapest_step.svg and strips.svg. gaits.csv comes
// last: a folder that holds it is complete.
void report_prior(const PriorReportJob& job, const JobControl& control);

// gaits.csv, survival.csv and cost.svg of the anthropomorphic walker's table.
void report_straight_prior(const PriorReportJob& job, const JobControl& control);

}  // namespace jobs
}  // namespace walktrack
