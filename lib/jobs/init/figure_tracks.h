// Follows figures in the image from frame to frame.
#pragma once

#include <cstddef>
#include <vector>

namespace walktrack {
inline namespace jobs {

// A person in one frame, px of the video.
struct SeenFigure {
  double time = 0;    // s
  int frame = 0;      // of the video
  size_t person = 0;  // index of the person in the frame
  double u_px = 0, top_px = 0, bottom_px = 0;
};

inline double size_of(const SeenFigure& figure) { return figure.bottom_px - figure.top_px; }

// The figures of one person in several frames, at least one.
using FigureTrack = std::vector<SeenFigure>;

double median_size(const FigureTrack& track);

// Adds the figure to the track of the person who was last seen there, otherwise begins a new track.
void link(const SeenFigure& figure, std::vector<FigureTrack>& tracks);

// The distance that somebody moves across the image, in their heights.
double way_across(const FigureTrack& track);
// The same plus the change of size: the logarithm of the largest size over the smallest one.
double way_anywhere(const FigureTrack& track);

// The track that goes farthest, because other people may stand about; empty if there is none.
FigureTrack walker_of(const std::vector<FigureTrack>& tracks, double (*way)(const FigureTrack&));

}  // namespace jobs
}  // namespace walktrack
