// The overlap of figure and person (tracker/figure_fit.h) over the frames of a track. Frames count
// by how much of the figure is in front of a known background.
#pragma once

#include <span>
#include <vector>

#include "tracker/walker_filter.h"

namespace walktrack {
inline namespace tracker {

// By frame; of a frame that is not tracked, nothing. `records`: a range of FrameRecord.
template <typename Records>
std::vector<FigureFit> fits_of(const Records& records) {
  std::vector<FigureFit> out;
  for (const FrameRecord& record : records)
    out.push_back(record.tracked ? record.fit : FigureFit{});
  return out;
}

// By camera, the mean over frames; NaN if it is unknown.
std::vector<double> mean_overlaps(std::span<const FigureFit> fits);

// How far the mean overlap of half a second falls below the median of the two seconds before: the
// largest such fall of all cameras and of all stretches that end in one of the `newest` frames. It
// shows that the figure has left the person; the overlap itself also differs with clothes and
// background. 0 if it falls nowhere, or too little is known. `dt`: s between frames.
double largest_overlap_fall(std::span<const FigureFit> fits, double dt, size_t newest);
// So many frames before a stretch's last one are looked at.
size_t frames_of_fall(double dt);

}  // namespace tracker
}  // namespace walktrack
