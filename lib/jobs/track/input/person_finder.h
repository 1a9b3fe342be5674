// Where a pose network is to look in a picture of one camera.
//
// While the subject is tracked, around them. Before, nobody knows: a square that has shown a person
// is followed to where their points are, for up to two people, and one more square a frame goes
// over the picture in turn, the whole of it first.
#pragma once

#include <optional>
#include <vector>

#include "observation/observer.h"
#include "observation/pose_net/pose_net.h"

namespace walktrack {
inline namespace jobs {

// How much larger than a person the square around them is.
inline constexpr double kCutOutMargin = 1.35;

// A square of the picture as recorded around a region of the shrunk image.
CutOut cut_out_around(const Region& region, int shrink, double height);

// The square around somebody who was seen; nothing when too little of a person is there. It wants
// shoulders, hips and a knee or an ankle.
std::optional<CutOut> cut_out_around(const DetectedPerson& person);

// Squares that cover a picture: the whole of it, then pieces that show a person of `person_px` at a
// good size, half overlapping.
std::vector<CutOut> squares_over(int width_px, int height_px, double person_px);

class PersonFinder {
 public:
  PersonFinder(int width_px, int height_px, double person_px)
      : squares_(squares_over(width_px, height_px, person_px)) {}

  // Looks into the frame of that number.
  DetectedPeople look(PoseNet& net, const cv::Mat& picture, int frame);
  // Begins anew.
  void forget() { followed_.clear(); }

 private:
  std::vector<CutOut> squares_, followed_;
};

}  // namespace jobs
}  // namespace walktrack
