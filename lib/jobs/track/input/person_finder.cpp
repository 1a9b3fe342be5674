#include "jobs/track/input/person_finder.h"

#include <algorithm>
#include <array>
#include <cmath>

#include "observation/image.h"

namespace walktrack {
inline namespace jobs {

namespace {

constexpr size_t kMostFollowed = 2;
constexpr float kSeen = 0.25f;  // least confidence of a visible point
// Lengths of the trunk and of the lower leg of a person as shares of their height.
constexpr double kTrunkShare = 0.288, kLowerShare = 0.53;

CutOut square(double x, double y, double side) {
  return {static_cast<int>(std::lround(x - side / 2)), static_cast<int>(std::lround(y - side / 2)),
          std::max(1, static_cast<int>(std::lround(side)))};
}

struct Middle {
  double x = 0, y = 0;
  int points = 0;
};

Middle middle_of(const DetectedPerson& person, std::initializer_list<KeypointName> names) {
  Middle out;
  for (const KeypointName name : names) {
    const Keypoint& point = person[name];
    if (point.confidence < kSeen) continue;
    out.x += point.x_px;
    out.y += point.y_px;
    ++out.points;
  }
  if (out.points > 0) {
    out.x /= out.points;
    out.y /= out.points;
  }
  return out;
}

// Whether two squares contain the same person.
bool alike(const CutOut& a, const CutOut& b) {
  const double apart = std::hypot(a.x0 + a.side_px / 2.0 - b.x0 - b.side_px / 2.0,
                                  a.y0 + a.side_px / 2.0 - b.y0 - b.side_px / 2.0);
  return apart < 0.25 * std::max(a.side_px, b.side_px);
}

}  // namespace

CutOut cut_out_around(const Region& region, int shrink, double height) {
  const double side = kCutOutMargin * height / region.metres_per_px * shrink;
  const PixelRect& there = region.subject.empty() ? region.area : region.subject;
  return square(0.5 * shrink * (there.x0 + there.x1), 0.5 * shrink * (there.y0 + there.y1), side);
}

std::optional<CutOut> cut_out_around(const DetectedPerson& person) {
  using enum KeypointName;
  const Middle shoulders = middle_of(person, {kLeftShoulder, kRightShoulder});
  const Middle hips = middle_of(person, {kLeftHip, kRightHip});
  const Middle lower = middle_of(person, {kLeftKnee, kRightKnee, kLeftAnkle, kRightAnkle});
  if (shoulders.points == 0 || hips.points == 0 || lower.points == 0) return std::nullopt;
  const double trunk = std::hypot(shoulders.x - hips.x, shoulders.y - hips.y);
  const double ankle = middle_of(person, {kLeftAnkle, kRightAnkle}).y;
  const double height = std::max({trunk / kTrunkShare, (ankle - hips.y) / kLowerShare, 1.0});
  return square(hips.x, hips.y, kCutOutMargin * height);
}

std::vector<CutOut> squares_over(int width_px, int height_px, double person_px) {
  const int whole = std::max(width_px, height_px);
  std::vector<CutOut> out{{(width_px - whole) / 2, (height_px - whole) / 2, whole}};
  const int side = std::max(1, static_cast<int>(std::lround(2 * kCutOutMargin * person_px)));
  if (side >= whole) return out;
  const auto steps = [&](int length) { return std::max(1, (2 * length - 1) / side); };
  for (int row = 0; row < steps(height_px); ++row)
    for (int column = 0; column < steps(width_px); ++column)
      out.push_back({column * side / 2, row * side / 2, side});
  return out;
}

DetectedPeople PersonFinder::look(PoseNet& net, const Image& frame, int number) {
  const PartOfFrame all_of_it = [&](const CutOut&) { return ImagePart{frame}; };
  return look(net, all_of_it, number);
}

DetectedPeople PersonFinder::look(PoseNet& net, const PartOfFrame& frame, int number) {
  DetectedPeople people;
  std::vector<CutOut> next;
  const auto person_in = [&](const CutOut& where) { return net.detect(frame(where), where); };
  const auto take = [&](const CutOut& where, bool refine) {
    DetectedPerson person = person_in(where);
    std::optional<CutOut> around = cut_out_around(person);
    if (!around) return;
    const auto known = [&] {
      return std::any_of(next.begin(), next.end(),
                         [&](const CutOut& other) { return alike(other, *around); });
    };
    if (known()) return;
    if (refine) {
      person = person_in(*around);
      around = cut_out_around(person);
      if (!around || known()) return;
    }
    people.push_back(person);
    next.push_back(*around);
  };
  for (const CutOut& where : followed_) take(where, false);
  const int every = next.empty() ? 1 : scan_every_;
  if (next.size() < kMostFollowed && number % every == 0)
    take(squares_[static_cast<size_t>(number / every) % squares_.size()], true);
  followed_ = std::move(next);
  return people;
}

}  // namespace jobs
}  // namespace walktrack
