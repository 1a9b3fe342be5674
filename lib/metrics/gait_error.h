// Errors of gait parameters that sample motions do not contain.
//
// The samples of a track (tracker/smooth/posterior.h) contain what images and ground leave open,
// and how far the tracker's body is from the subject's. They all have the tracker's feet, which
// leave the ground in another way than those of people: all samples have the same error of heel
// strike and toe-off. Errors of two strikes are alike, and so are those of two toe-offs: a step
// time has none of it, a stance has that of one strike and one toe-off, double support that of two
// each. Step widths have a share of the figure's error across the walk, since one camera places
// each foot by itself; so have walking bases and widths at the strike. All samples have the same
// standard foot, which points and clears the ground in another way than people's. From step to
// step, what differs from one error to the next looks like the walker's.
//
// These errors are added here, as independent normal errors of every number of a table; the values
// do not change. The sizes were fitted on walks with truth (lib/tracker/reports/bands.md).
#pragma once

#include "metrics/gait_table.h"

namespace walktrack {
inline namespace metrics {

// Standard deviations of the figure as a whole.
struct FigureError {
  double scale = 0;   // of its distance from the camera that determines it best, as a share
  double across = 0;  // m, over the ground, across the walk
};

// Widens the table's bands by `weight` times the errors' sizes. Numbers without a band stay so.
void add_gait_error(const FigureError& figure, double weight, GaitTable& table);

}  // namespace metrics
}  // namespace walktrack
