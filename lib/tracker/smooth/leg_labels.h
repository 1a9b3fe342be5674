// Which leg is which, of a whole track: a chain of two states, "named as tracked" and "swapped",
// over its frames, with what each frame says of the names (FrameRecord::names) and a small chance
// that the track has taken one leg for the other between two frames. Forward and backward through
// all of them (Rabiner, Proc. IEEE 77, 1989, section III) every frame is judged by the whole video.
#pragma once

#include <span>
#include <vector>

namespace walktrack {
inline namespace tracker {

struct NamedFrame {
  bool tracked = false;
  double odds = 0;     // nats that this frame speaks for the names as tracked
  double swapped = 0;  // probability that they are swapped, for all that the track knew itself;
                       // asked where it begins
};

// A track swaps the legs so often, 1/s: 4 of 40 tracks of rendered walks of some five seconds
// did, most of them once.
inline constexpr double kSwapsPerSecond = 0.02;

// Of every frame the probability that its legs are swapped, given all frames, `dt` s apart; 0 where
// nothing is tracked. Tracks before and after a loss know nothing of each other.
std::vector<double> swapped_probabilities(std::span<const NamedFrame> frames, double dt);

// The same as far as a track has come: whether left and right are in doubt, so that more evidence
// is worth its cost.
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
