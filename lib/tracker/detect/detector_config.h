// The configuration of the search for a walk (tracker/detect/detector.h).
#pragma once

namespace walktrack {
inline namespace tracker {

// By hand; sensitivity not measured.
struct DetectorConfig {
  double window = 1.2;       // s of video in which a walk is searched: two steps
  double slowest = 0.35;     // m/s, lowest speed of a walk
  double fastest = 3.0;      // m/s
  double least_share = 0.5;  // lowest score of a frame, as a share of the window's median
  // nats, lowest score of the figure in any frame if outlines count in full
  double least_score = 6;
  // The same if there are only keypoints: nine points of a network at the places where a figure has
  // them contribute 5.6 nats.
  double least_points_score = 1;
  int candidates = 10;  // places of a frame through which lines are tried
  int grid_px = 8;      // spacing of the pixel grid at 640 px of image width
};

}  // namespace tracker
}  // namespace walktrack
