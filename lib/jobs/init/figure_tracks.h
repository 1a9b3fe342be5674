// Follows the figures that a camera sees from frame to frame.
#pragma once

#include <cstddef>
#include <vector>

namespace walktrack {
inline namespace jobs {

// Somebody in one frame, px of the video.
struct SeenFigure {
  double time = 0;    // s
  int frame = 0;      // of the video
  size_t person = 0;  // of those in the frame
  double u_px = 0, top_px = 0, bottom_px = 0;
};

inline double size_of(const SeenFigure& figure) { return figure.bottom_px - figure.top_px; }

// One person's figures through the frames, at least one.
using FigureTrack = std::vector<SeenFigure>;

double median_size(const FigureTrack& track);

// Adds the figure to the track of whoever was last seen where it is now, else begins one.
void link(const SeenFigure& figure, std::vector<FigureTrack>& tracks);

// How far somebody goes across the picture, in their heights.
double way_across(const FigureTrack& track);
// As above, and how much larger or smaller they become: the logarithm of the largest size's share
// of the smallest one's.
double way_anywhere(const FigureTrack& track);

// Who goes farthest: others stand about. Empty where there is nobody.
FigureTrack walker_of(const std::vector<FigureTrack>& tracks, double (*way)(const FigureTrack&));

}  // namespace jobs
}  // namespace walktrack
