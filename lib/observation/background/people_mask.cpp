#include "observation/background/people_mask.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

#include <opencv2/imgproc.hpp>

namespace walktrack {
inline namespace observation {

namespace {

constexpr float kSeen = 0.1f;  // confidence of a point that may belong to a person
// Shares of the height of the points, which extend from the eyes to the ankles, about 0.85 of a
// standing person; by hand. Feet with their shadow, and the top of the head, extend further beyond
// their points than a limb is wide.
constexpr double kLimbShare = 0.07, kFootShare = 0.14, kHairShare = 0.14;
constexpr double kTrunkShare = 0.32;  // from shoulders to hips, for people who bend forward

cv::Point2d at(const DetectedPerson& person, KeypointName name) {
  return {person[name].x_px, person[name].y_px};
}

double trunk_of(const DetectedPerson& person) {
  using enum KeypointName;
  const cv::Point2d apart = at(person, kLeftShoulder) + at(person, kRightShoulder) -
                            at(person, kLeftHip) - at(person, kRightHip);
  return 0.5 * std::hypot(apart.x, apart.y);
}

cv::Point whole(const cv::Point2d& point) {
  return {static_cast<int>(std::lround(point.x)), static_cast<int>(std::lround(point.y))};
}

void fill_person(const DetectedPerson& person, cv::Mat& mask) {
  using enum KeypointName;
  std::vector<cv::Point> points;
  for (size_t i = 0; i < kKeypointCount; ++i)
    if (const auto name = static_cast<KeypointName>(i); person[name].confidence >= kSeen)
      points.push_back(whole(at(person, name)));
  if (points.empty()) return;
  const double span = std::max(static_cast<double>(cv::boundingRect(points).height),
                               trunk_of(person) / kTrunkShare);
  const auto width = [&](double share) {
    return std::max(1, static_cast<int>(std::lround(share * span)));
  };
  std::vector<cv::Point> hull;
  cv::convexHull(points, hull);
  const cv::Scalar somebody(255);
  cv::fillConvexPoly(mask, hull, somebody);
  cv::polylines(mask, hull, true, somebody, 2 * width(kLimbShare));
  for (const auto& [name, share] :
       {std::pair{kNose, kHairShare}, {kLeftAnkle, kFootShare}, {kRightAnkle, kFootShare}})
    if (person[name].confidence >= kSeen)
      cv::circle(mask, whole(at(person, name)), width(share), somebody, cv::FILLED);
}

}  // namespace

cv::Mat people_mask(const DetectedPeople& people, cv::Size size) {
  cv::Mat mask(size, CV_8U, cv::Scalar(0));
  for (const DetectedPerson& person : people) fill_person(person, mask);
  return mask;
}

}  // namespace observation
}  // namespace walktrack
