#include "tracker/others/nearby_people.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/LU>

#include "observation/silhouette/foreground_sums.h"
#include "tracker/others/person_boxes.h"

namespace walktrack {
inline namespace tracker {

namespace {

using Eigen::Vector2d;

// By hand, chosen on pedestrians of PETS (reports/other_people.md).
//
// Somebody new explains at least kNewShare of the usual score, outside of boxes with the margin
// kNewMargin, m, around those who are known, and is certain after kCertain s. They are looked for
// every kBetweenLooks s, up to kNewWithin m from the subject, at places kStep m apart, but not
// closer to anybody known than the two last distances, m.
constexpr double kNewShare = 0.5, kNewMargin = 0.3, kCertain = 0.1;
constexpr double kBetweenLooks = 0.1;
constexpr double kNewWithin = 3.5, kStep = 0.3, kApartFromSubject = 0.6, kApartFromOthers = 0.5;
constexpr size_t kMostOthers = 6;
// Somebody with less than this share of the usual score is not seen; who has not been seen for
// kForget s, or is kGone m away, is forgotten.
constexpr double kSeenShare = 0.15, kForget = 1.5, kGone = 4.5;
// Standard deviations of what one look shows of a place, along the first camera's ray and across
// it, m; looks are kLook s apart, and frames between them repeat the same errors.
constexpr double kSeenAlong = 0.3, kSeenAcross = 0.06, kLook = 0.14;
constexpr double kUnknownVelocity = 1;  // m/s, standard deviation
// The share that a look counts while people are in front of one another.
constexpr double kOverlappingShare = 0.2;
constexpr double kTrackSd = 0.05;         // of the track's place, m
constexpr double kStartVelocitySd = 0.3;  // of the subject, m/s
constexpr double kUsualOver = 0.5;        // s, of the moving mean
constexpr double kHiddenShare = 0.3;      // of the usual score below which the subject is hidden
constexpr double kClimb = 0.16, kLastClimb = 0.03;  // m
constexpr int kClimbsOfStep = 4;

// What a frame counts, in looks.
double looks_in(double dt) { return std::min(1.0, dt / kLook); }

// The axes along the first camera's ray to a place and across it, as columns.
Eigen::Matrix2d ray_axes(const TrackContext& context, const Vector2d& place) {
  const Vector2d along =
      (place - camera_centre(context.scene.cameras[0]).head<2>()).stableNormalized();
  Eigen::Matrix2d out;
  out << along, Vector2d(-along.y(), along.x());
  return out;
}

// The information about a place in one look, m^-2.
Eigen::Matrix2d look_information(const Eigen::Matrix2d& axes) {
  const Vector2d each(1 / (kSeenAlong * kSeenAlong), 1 / (kSeenAcross * kSeenAcross));
  return axes * each.asDiagonal() * axes.transpose();
}

// Of a figure that walks there, by outlines alone, nats.
double walker_score(const TrackContext& context, const SceneEvidence& evidence,
                    const Vector2d& place, const Vector2d& velocity) {
  const double heading = std::atan2(velocity.y(), velocity.x());
  return outline_score(context.scene, evidence, context.body(),
                       context.subject.figures.at(velocity.norm(), heading), place, heading);
}

// Moves `place` along the axes to the largest value nearby.
template <typename F>
void climb(const F& value, const Eigen::Matrix2d& axes, Vector2d& place) {
  double best = value(place);
  for (double step = kClimb; step > kLastClimb; step /= 2) {
    for (int i = 0; i < kClimbsOfStep; ++i) {
      const Vector2d from = place;
      for (const double way : {step, -step}) {
        for (int axis = 0; axis < 2; ++axis) {
          const Vector2d tried = from + way * axes.col(axis);
          const double there = value(tried);
          if (there > best) {
            best = there;
            place = tried;
          }
        }
      }
      if (place == from) break;
    }
  }
}

// `theirs`: the evidence that belongs to that person. `least`: the smallest score of somebody seen.
void follow(const TrackContext& context, const SceneEvidence& theirs, double least,
            bool overlapping, OtherPerson& other) {
  const double looks = (overlapping ? kOverlappingShare : 1) * looks_in(context.scene.dt);
  const MovingPerson expected = predicted(other.place, context.scene.dt);
  const Eigen::Matrix2d inverse = expected.position_covariance().inverse(),
                        axes = ray_axes(context, expected.position());
  Vector2d place = expected.position();
  climb(
      [&](const Vector2d& tried) {
        const Vector2d off = tried - expected.position();
        return looks * walker_score(context, theirs, tried, expected.velocity()) -
               0.5 * off.dot(inverse * off);
      },
      axes, place);
  const double score = walker_score(context, theirs, place, expected.velocity());
  if (score < least) {
    other.place = expected;
    ++other.unseen;
    return;
  }
  other.unseen = 0;
  ++other.seen;
  other.place = found_at(expected, place, looks * look_information(axes));
}

bool is_certain(const OtherPerson& other, double dt) {
  return other.seen >= frames_in(kCertain, dt);
}

// The places of all, the subject first.
std::vector<Vector2d> known_places(const NearbyPeople& people) {
  std::vector<Vector2d> out{people.subject.position()};
  for (const OtherPerson& other : people.others) out.push_back(other.place.position());
  return out;
}

void follow_known(const TrackContext& context, const SceneEvidence& evidence,
                  NearbyPeople& people) {
  std::vector<Vector2d> expected{people.subject.position()};
  for (const OtherPerson& other : people.others)
    expected.push_back(predicted(other.place, context.scene.dt).position());
  for (size_t i = 0; i < people.others.size(); ++i) {
    const Vector2d own = expected[i + 1];
    std::vector<Vector2d> rest = expected;
    rest.erase(rest.begin() + static_cast<long>(i) + 1);
    const bool overlapping = std::ranges::any_of(
        rest, [&](const Vector2d& other) { return behind_one_another(context, own, other); });
    SceneEvidence theirs = outlines_of(evidence);
    hide_others(context, rest, own, theirs);
    follow(context, theirs, kSeenShare * people.usual_score, overlapping, people.others[i]);
  }
}

void forget_gone(double dt, NearbyPeople& people) {
  std::erase_if(people.others, [&](const OtherPerson& other) {
    return dt * other.unseen > kForget || (other.unseen > 0 && !is_certain(other, dt)) ||
           (other.place.position() - people.subject.position()).norm() > kGone;
  });
}

// The evidence that nobody known explains, in boxes.
class Unexplained {
 public:
  Unexplained(const TrackContext& context, const SceneEvidence& evidence,
              const NearbyPeople& people)
      : context_(context) {
    const std::vector<Vector2d> known = known_places(people);
    for (size_t c = 0; c < evidence.size(); ++c) {
      std::vector<PixelRect> boxes;
      for (const Vector2d& place : known)
        boxes.push_back(person_box(context, c, place, kNewMargin));
      sums_.emplace_back(evidence[c].planes, boxes);
      weights_.push_back(evidence[c].pixel_weight);
    }
  }
  double all() const {
    double sum = 0;
    for (size_t c = 0; c < sums_.size(); ++c) sum += weights_[c] * sums_[c].all();
    return sum;
  }
  double around(const Vector2d& place) const {
    double sum = 0;
    for (size_t c = 0; c < sums_.size(); ++c)
      sum += weights_[c] * sums_[c].within(person_box(context_, c, place, kNewMargin));
    return sum;
  }

 private:
  const TrackContext& context_;
  std::vector<ForegroundSums> sums_;
  std::vector<double> weights_;
};

bool is_apart(const NearbyPeople& people, const Vector2d& place) {
  return (place - people.subject.position()).norm() >= kApartFromSubject &&
         std::ranges::none_of(people.others, [&](const OtherPerson& other) {
           return (place - other.place.position()).norm() < kApartFromOthers;
         });
}

std::vector<Vector2d> places_near(const Vector2d& middle) {
  const int reach = static_cast<int>(kNewWithin / kStep);
  std::vector<Vector2d> out;
  for (int i = -reach; i <= reach; ++i)
    for (int j = -reach; j <= reach; ++j) out.push_back(middle + kStep * Vector2d(i, j));
  return out;
}

// The place of somebody new; nullopt if there is nobody.
std::optional<Vector2d> somebody_new(const TrackContext& context, const SceneEvidence& evidence,
                                     const NearbyPeople& people) {
  const double least = kNewShare * people.usual_score;
  const Unexplained unexplained(context, evidence, people);
  if (unexplained.all() < least) return std::nullopt;
  SceneEvidence rest;
  const Vector2d slowly = 0.01 * people.subject.velocity();
  std::optional<Vector2d> best;
  double most = least;
  for (const Vector2d& place : places_near(people.subject.position())) {
    // No figure in a box explains more than all of the box.
    if (!is_apart(people, place) || unexplained.around(place) < most) continue;
    if (rest.empty()) {
      rest = outlines_of(evidence);
      hide_people(context, known_places(people), kNewMargin, rest);
    }
    const double score = walker_score(context, rest, place, slowly);
    if (score <= most) continue;
    most = score;
    best = place;
  }
  if (!best) return std::nullopt;
  climb([&](const Vector2d& tried) { return walker_score(context, rest, tried, slowly); },
        ray_axes(context, *best), *best);
  return is_apart(people, *best) ? best : std::nullopt;
}

}  // namespace

NearbyPeople alone(const Vector2d& position, const Vector2d& velocity) {
  const Eigen::Matrix2d place = kTrackSd * kTrackSd * Eigen::Matrix2d::Identity();
  return {.subject = moving_person(position, place, velocity, kStartVelocitySd),
          .usual_score = 0,
          .frames = 0,
          .others = {}};
}

void follow_others(const TrackContext& context, const SceneEvidence& evidence,
                   NearbyPeople& people) {
  const double dt = context.scene.dt;
  const double own =
      walker_score(context, evidence, people.subject.position(), people.subject.velocity());
  double& usual = people.usual_score;
  if (people.frames == 0)
    usual = own;
  else if (own > kHiddenShare * usual)
    usual += (1 - std::exp(-dt / kUsualOver)) * (own - usual);
  follow_known(context, evidence, people);
  forget_gone(dt, people);
  const auto step = static_cast<int>(std::max(1L, std::lround(kBetweenLooks / dt)));
  if (people.frames++ % step != 0 || usual <= 0) return;
  while (people.others.size() < kMostOthers) {
    const std::optional<Vector2d> place = somebody_new(context, evidence, people);
    if (!place) break;
    const Eigen::Matrix2d covariance = look_information(ray_axes(context, *place)).inverse();
    people.others.push_back(
        {moving_person(*place, covariance, Vector2d::Zero(), kUnknownVelocity), 1, 0});
  }
}

bool somebody_is_near(const NearbyPeople& people) { return !people.others.empty(); }

std::optional<SceneEvidence> without_others(const TrackContext& context, const NearbyPeople& people,
                                            const SceneEvidence& evidence) {
  std::vector<Vector2d> certain;
  for (const OtherPerson& other : people.others)
    if (is_certain(other, context.scene.dt)) certain.push_back(other.place.position());
  if (certain.empty()) return std::nullopt;
  SceneEvidence out = evidence;
  hide_others(context, certain, people.subject.position(), out);
  return out;
}

void expect_subject(const TrackContext& context, const Vector2d& place, NearbyPeople& people) {
  const double dt = context.scene.dt;
  const bool overlapping = std::ranges::any_of(people.others, [&](const OtherPerson& other) {
    return is_certain(other, dt) &&
           behind_one_another(context, people.subject.position(), other.place.position());
  });
  const double looks = (overlapping ? kOverlappingShare : 1) * looks_in(dt);
  people.subject = predicted(measured_at(people.subject, place, kTrackSd / std::sqrt(looks)), dt);
}

}  // namespace tracker
}  // namespace walktrack
