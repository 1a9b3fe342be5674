// gait.json and gait.csv: the gait of one walk (metrics/gait_table.h).
//
// gait.json
//   format      "walktrack gait 1"
//   time_zero   "first frame of the scene": what times count from, s
//   events      [{event: "foot_strike" | "toe_off", side: "left" | "right", time_s: band}], by time
//   contacts    [{side, <column>: band, …}], by time; columns: kContactColumns
//   summary     {steps, strides, turning_steps, both: {<column>: band, …}, left: {…}, right: {…},
//                symmetry: {<column>: band, …}}; columns: kSummaryColumns, kSymmetryColumns;
//                left: steps that end with the left foot, strides that begin with it
//   band        {value, p05, p95}; null where there is none
//   notes       [what the numbers mean, for people]
// Units are in the names: s, m, m_s, deg, per_min, percent.
//
// gait.csv: side,<column>,<column>_p05,<column>_p95,… for every contact. Summaries are in gait.json
// only.
#pragma once

#include <string>

#include "io/tables/table_notes.h"
#include "metrics/gait_table.h"

namespace walktrack {
inline namespace io {

std::string gait_json(const GaitTable& table);
std::string gait_csv(const GaitTable& table);

// The notes on "gait.csv".
TableNotes gait_notes();

}  // namespace io
}  // namespace walktrack
