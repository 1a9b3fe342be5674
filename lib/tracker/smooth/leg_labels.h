// Which leg is the left one, for a whole track: a Markov chain of two states, "labels as tracked"
// and "swapped", over its frames, with the evidence of each frame about the labels
// (FrameRecord::names) and a small probability that the track swaps the legs between two frames.
// The forward-backward algorithm (Rabiner, Proc. IEEE 77, 1989, section III) judges every frame by
// the whole video.
#pragma once

#include <span>
#include <vector>

namespace walktrack {
inline namespace tracker {

struct NamedFrame {
  bool tracked = false;
  double odds = 0;     // nats, evidence of this frame for the labels as tracked
  double swapped = 0;  // probability that they are swapped by the tracker's own evidence; used for
                       // the first frame of a track
};

// How often a track swaps the legs, 1/s: 4 of 40 tracks of rendered walks of some five seconds
// did, most of them once.
inline constexpr double kSwapsPerSecond = 0.02;

// For every frame the probability that its legs are swapped, given all frames, `dt` s apart; 0
// where nothing is tracked. Tracks before and after a loss are independent.
std::vector<double> swapped_probabilities(std::span<const NamedFrame> frames, double dt);

// The same for the frames so far: whether left and right are uncertain, so that more evidence is
// worth its cost.
class NamesSoFar {
 public:
  void add(const NamedFrame& frame, double dt);
  bool in_doubt() const;

 private:
  bool tracked_ = false;
  double log_odds_ = 0;  // of "swapped"
};

}  // namespace tracker
}  // namespace walktrack
