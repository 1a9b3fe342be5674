// The expected cost of a frame of tracking: the counts of the operations times the cost of each.
//
//   decoding     a d                      a: pixels of a camera's frame as it was recorded
//   pose network i                        for every cut-out on which it is run
//   each likelihood term that is on, see Term::cost (observation/terms.h), such as
//     background   b r                    r: pixels of the shrunk image around the walker
//     appearance   c k                    k: appearance classes
//     flow         e r + f n m            n: evaluated poses, m: parts of the body
//     silhouettes  h n y                  y: rows of the shrunk image that the walker covers
//   projection   g n m                    parts and their outlines in the image
// These are for every camera, where for all cameras except the first n is the number of particles
// and of the moves that the first camera has accepted. Once for all cameras there are
//   walker       w p                      p: particles
//   poses        q n m + s
//
// The coefficients are CPU times of all threads together, fitted by scripts/measure_costs.py to
// frames after the start hypotheses of the first half second. They are those of one machine: ratios
// carry over to others, times only roughly. Over the fifteen settings of the fit the sum had an
// error of 9 % (median), and 24 % at worst (arms), given the poses that were really evaluated;
// their number varies by a third between scenes, so that for ten videos, balanced and fast, the
// plan had an error of 12 % (median), and 31 % at worst. It does not include searching and the
// start hypotheses of the first half second, learning the background before the first frame, and
// writing results.
#pragma once

#include <string>
#include <utility>
#include <vector>

#include "observation/observation_config.h"

namespace walktrack {
inline namespace jobs {

struct CameraWork {
  std::string name;
  double filmed_px = 0;  // pixels of a recorded frame
  double region_px = 0;  // pixels of the shrunk image around the subject
  double rows = 0;       // height of the subject there
  double looks = 0;      // runs of the pose network for each frame
};

struct FrameWork {
  std::vector<CameraWork> cameras;
  double particles = 0;  // also those of components that turn (tracker/modes/turning.h)
  double poses = 0;  // poses evaluated in a frame by the first camera, for all particles and moves
  int parts = 0;     // of the body
  int classes = 0;   // appearance classes; 0 = appearance is off
  ObservationConfig terms;
};

// CPU ms of each item that is on.
using Costs = std::vector<std::pair<std::string, double>>;

// CPU ms for a frame.
struct FrameCost {
  std::vector<Costs> cameras;  // in the order of the work
  double walker = 0, poses = 0;
  double sum() const;
};

double sum(const Costs& costs);

FrameCost frame_cost(const FrameWork& work);

// Poses evaluated in a frame: each particle once, and again for each move after every tempered
// layer. The number of layers depends on how well frames are predicted; this is the usual number
// for walks, which grows with the evidence.
double usual_layers(int cameras, int max_layers);

}  // namespace jobs
}  // namespace walktrack
