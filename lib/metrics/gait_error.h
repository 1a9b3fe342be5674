// Errors of gait parameters that the spread of the particles does not contain: the person is not a
// kneed walker, and the whole figure may be a little off in the cameras.
//
// The members of an ensemble agree on the gait of the body that explains the images best. Because a
// person's feet land in another way than the body's, events and steps have the same errors in all
// members. These errors are added here, as independent normal errors of every number of a table;
// the values do not change.
//
// The uncertainty of the whole figure follows from the places of the cameras
// (tracker/smooth/model_error.h): lengths and speeds have the relative error of its distance,
// widths a part of its error across the walk. The other sizes were fitted on walks with truth;
// lib/tracker/reports/bands.md says on which walks and how, and how often the bands contain the
// truth. Means over steps have sizes of their own, because the errors of steps do not average out;
// for the means of one side they are sqrt(2) times as large.
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
