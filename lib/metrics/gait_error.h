// What the particles' spread leaves out of gait's bands: the person is no kneed walker, and cameras
// see the whole figure a little wrong.
//
// Members of an ensemble agree on the gait of the body that explains the images best. That a
// person's feet land otherwise than the body's moves events and steps in the same way in all
// members. It is added here, as independent normal errors of every number of a table; values stay.
//
// What cameras leave open of the figure comes from where they stand (tracker/smooth/model_error.h):
// lengths and speeds share the relative error of its distance, widths part of its error across the
// way. The other sizes were fitted on walks with truth; lib/tracker/reports/bands.md says on which,
// how, and what the bands hold since. Means over steps come with sizes of their own, as errors of
// steps do not average out; where one side's are meant, they are sqrt(2) times as large.
#pragma once

#include "metrics/gait_table.h"

namespace walktrack {
inline namespace metrics {

// Standard deviations of what is known of the figure as a whole.
struct FigureError {
  double scale = 0;   // of its distance from the camera that knows it best, share of it
  double across = 0;  // m, over the ground, across the way
};

// Widens the table's bands by `weight` times the errors' sizes. Numbers without a band stay so.
void add_gait_error(const FigureError& figure, double weight, GaitTable& table);

}  // namespace metrics
}  // namespace walktrack
