// Selects the parts of a camera's image on which the pose network is run.
//
// While the subject is tracked, it is the square around them. Before, squares with up to two people
// are moved to the detected points, and one more square scans the image in turn, beginning with the
// whole image.
#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "observation/image.h"
#include "observation/observer.h"
#include "observation/pose_net/pose_net.h"

namespace walktrack {
inline namespace jobs {

// Size of the square around a person relative to the person.
inline constexpr double kCutOutMargin = 1.35;

// A square of the recorded image around a region of the shrunk image.
CutOut cut_out_around(const Region& region, int shrink, double height);

// The square around a detected person; nullopt unless shoulders, hips and a knee or an ankle were
// detected.
std::optional<CutOut> cut_out_around(const DetectedPerson& person);

// Squares that cover an image: the whole of it, then overlapping squares in which a person of
// `person_px` has a suitable size.
std::vector<CutOut> squares_over(int width_px, int height_px, double person_px);

// Returns the part of a frame that a cut-out covers, or more.
using PartOfFrame = std::function<ImagePart(const CutOut&)>;

class PersonFinder {
 public:
  // While somebody is followed, only one in `scan_every` frames is scanned for others.
  PersonFinder(int width_px, int height_px, double person_px, int scan_every = 1)
      : squares_(squares_over(width_px, height_px, person_px)), scan_every_(scan_every) {}

  // Runs the network on the frame of that number.
  DetectedPeople look(PoseNet& net, const PartOfFrame& frame, int number);
  DetectedPeople look(PoseNet& net, const Image& frame, int number);
  // Forgets the people that were followed.
  void forget() { followed_.clear(); }

 private:
  std::vector<CutOut> squares_, followed_;
  int scan_every_;
};

}  // namespace jobs
}  // namespace walktrack
