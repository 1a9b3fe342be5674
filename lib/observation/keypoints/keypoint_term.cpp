#include "observation/keypoints/keypoint_term.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <span>

#include "observation/observed_frame.h"

namespace walktrack {
inline namespace observation {

namespace {

using Eigen::Vector2d;
using Person = KeypointEvidence::Person;
using Point = KeypointEvidence::Point;

// CPU time for a frame, nanoseconds: points of a pose are projected and compared with one person's.
constexpr double kPointsCompared = 1500;
// Smallest scale of an error, px of the shrunk image: detectors round.
constexpr double kLeastScale = 0.5;

// A person who is further away from a figure, in its heights, is somebody else. By hand.
constexpr double kNear = 0.5;

// Points whose left and right labels may be swapped together.
struct Group {
  size_t begin, end;
};
constexpr Group kHead{0, kFirstArmPoint}, kArms{kFirstArmPoint, kFirstLegPoint},
    kLegs{kFirstLegPoint, kBodyPoints};

double log_sum(double a, double b) {
  const double most = std::max(a, b);
  return most + std::log1p(std::exp(std::min(a, b) - most));
}

// A group's tempered sums of l_j, with the detector's labels and with swapped ones.
struct NamedSums {
  double as_named = 0, swapped = 0;
};

NamedSums sums(const KeypointConfig& config, const Person& person, const PointPixels& predicted,
               Group group) {
  double best = 0, far_named = 1, far_swapped = 1;  // products of up to ten numbers below 1e18
  for (size_t i = group.begin; i < group.end; ++i) {
    const Point& point = person[i];
    if (point.precision == 0) continue;
    best += point.at_best;
    far_named *= 1 + point.precision * (point.px - predicted[i]).squaredNorm();
    far_swapped *= 1 + point.precision * (point.px - predicted[mirrored(i)]).squaredNorm();
  }
  const double power = 0.5 * (config.dof + 2);
  return {config.weight * (best - power * std::log(far_named)),
          config.weight * (best - power * std::log(far_swapped))};
}

double group_score(const KeypointConfig& config, const NamedSums& sums) {
  return log_sum(std::log1p(-config.flip) + sums.as_named, std::log(config.flip) + sums.swapped);
}

double person_score(const KeypointConfig& config, const Person& person,
                    const PointPixels& predicted) {
  return sums(config, person, predicted, kHead).as_named +
         group_score(config, sums(config, person, predicted, kArms)) +
         group_score(config, sums(config, person, predicted, kLegs));
}

double people_score(const KeypointConfig& config, std::span<const Person> people,
                    const PointPixels& predicted) {
  double sum = 0;  // none of the people
  for (const Person& person : people) sum = log_sum(sum, person_score(config, person, predicted));
  return sum;
}

Person weighed(const KeypointConfig& config, const KeypointErrors& errors,
               const SeenPoints& points) {
  Person out;
  for (size_t i = 0; i < kBodyPoints; ++i) {
    if (points.confidence[i] == 0) continue;
    const double share = errors.scale[static_cast<size_t>(kind_of(i))];
    const double scale =
        std::max(kLeastScale, share * points.height_px / std::sqrt(points.confidence[i]));
    const double reach = std::max(scale, config.outlier * points.height_px);
    out[i] = {points.px[i], 1 / (config.dof * scale * scale),
              std::log(reach * reach / (2 * scale * scale))};
  }
  return out;
}

bool any_point(const SeenPoints& points) {
  return points.height_px > 0 && std::any_of(points.confidence.begin(), points.confidence.end(),
                                             [](double confidence) { return confidence > 0; });
}

// The person whom the pose explains best; nullptr if it explains none.
const Person* subject_of(const KeypointConfig& config, std::span<const Person> people,
                         const PointPixels& predicted) {
  const Person* best = nullptr;
  double most = 0;
  for (const Person& person : people) {
    const double score = person_score(config, person, predicted);
    if (score <= most) continue;
    best = &person;
    most = score;
  }
  return best;
}

// Height of the figure from its head to its ankles, px.
double height_of(const PointPixels& points) {
  constexpr size_t kAnkle = 2 * static_cast<size_t>(PointKind::kAnkle) - 1;
  return (points[0] - 0.5 * (points[kAnkle] + points[kAnkle + 1])).norm();
}

bool is_swapped(const KeypointConfig& config, const NamedSums& sums) {
  return std::log(config.flip) + sums.swapped > std::log1p(-config.flip) + sums.as_named;
}

}  // namespace

double median_distance(const KeypointEvidence::Person& person, const PointPixels& predicted) {
  std::vector<double> all;
  for (size_t i = 0; i < kBodyPoints; ++i)
    if (person[i].precision > 0) all.push_back((person[i].px - predicted[i]).norm());
  if (all.empty()) return std::numeric_limits<double>::quiet_NaN();
  const auto middle = all.begin() + static_cast<long>(all.size() / 2);
  std::nth_element(all.begin(), middle, all.end());
  return *middle;
}

KeypointTerm::Memory::Memory(const ObserverSetting&, ObserverInput& input)
    : arms_(input.appearances[static_cast<size_t>(Appearance::kArms)]) {}

void KeypointTerm::Memory::prepare(const ObserverSetting& setting, ObservedFrame& frame, int,
                                   Prepared& out) const {
  out.people.clear();
  if (!is_on(setting.config.keypoints)) return;
  for (const DetectedPerson& person : *frame.people) {
    const SeenPoints points = seen_points(person, setting.shrink, arms_);
    if (any_point(points)) out.people.push_back(points);
  }
}

void KeypointTerm::Memory::complete(const ObserverSetting& setting, ObservedFrame&,
                                    Prepared& prepared, CameraEvidence& out) {
  out.keypoints.people.clear();
  if (prepared.people.empty()) return;
  out.keypoints.offsets = offsets_of(state_.errors);
  for (const SeenPoints& points : prepared.people)
    out.keypoints.people.push_back(weighed(setting.config.keypoints, state_.errors, points));
}

void KeypointTerm::Memory::learn(const ObserverSetting& setting, const CameraEvidence& evidence,
                                 const FoundPose& found) {
  const KeypointEvidence& seen = evidence.keypoints;
  if (!found.body || seen.people.empty()) return;
  ++state_.use.frames;
  const KeypointConfig& config = setting.config.keypoints;
  const PointPixels predicted = point_pixels(setting.camera, *found.body, seen.offsets);
  const Person* const person = subject_of(config, seen.people, predicted);
  if (!person) return;
  ++state_.use.matched;
  for (const Group& group : {kHead, kArms, kLegs}) {
    const bool swapped = is_swapped(config, sums(config, *person, predicted, group));
    if (swapped && group.begin == kLegs.begin) ++state_.use.legs_flipped;
    for (size_t i = group.begin; i < group.end; ++i) {
      const Point& point = (*person)[i];
      const size_t meant = swapped ? mirrored(i) : i;
      if (point.precision == 0) continue;
      walktrack::learn(
          {meant, point.px - predicted[meant], 1 / std::sqrt(config.dof * point.precision),
           pixel_per_offset(setting.camera, *found.body, meant, seen.offsets)},
          config.dof, config.weight, state_.errors);
    }
  }
  walktrack::forget(state_.errors);
}

bool KeypointTerm::says(const CameraEvidence& evidence) {
  return !evidence.keypoints.people.empty();
}

double KeypointTerm::log_likelihood(const ObservationConfig& config, const CameraEvidence& evidence,
                                    const Camera& camera, const PosedBody& now, const PosedBody*) {
  const KeypointEvidence& seen = evidence.keypoints;
  return people_score(config.keypoints, seen.people, point_pixels(camera, now, seen.offsets));
}

std::optional<bool> KeypointTerm::on_somebody(const ObservationConfig& config,
                                              const CameraEvidence& evidence, const Camera& camera,
                                              const PosedBody& now) {
  const KeypointEvidence& seen = evidence.keypoints;
  if (seen.people.empty()) return std::nullopt;  // the offsets are not set either
  const PointPixels predicted = point_pixels(camera, now, seen.offsets);
  if (subject_of(config.keypoints, seen.people, predicted)) return true;
  const bool near = std::any_of(seen.people.begin(), seen.people.end(), [&](const Person& person) {
    return median_distance(person, predicted) < kNear * height_of(predicted);
  });
  return near ? std::optional(false) : std::nullopt;
}

TermCosts KeypointTerm::cost(const ObservationConfig& config, const TermWork& work) {
  if (!is_on(config.keypoints)) return {};
  return {{"keypoints", kPointsCompared * work.poses}};
}

double KeypointTerm::names_log_odds(const ObservationConfig& config, const Body&,
                                    const Camera& camera, const CameraEvidence&,
                                    const CameraEvidence& evidence, const PosedBody&,
                                    const PosedBody& now) {
  if (!says(evidence)) return 0;
  const KeypointEvidence& seen = evidence.keypoints;
  const PointPixels predicted = point_pixels(camera, now, seen.offsets);
  PointPixels swapped = predicted;
  for (size_t i = kFirstLegPoint; i < kBodyPoints; ++i) swapped[i] = predicted[mirrored(i)];
  return people_score(config.keypoints, seen.people, predicted) -
         people_score(config.keypoints, seen.people, swapped);
}

}  // namespace observation
}  // namespace walktrack
