#include "observation/two_views/walker_rays.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/conventions.h"
#include "core/median.h"

namespace walktrack {
inline namespace observation {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

namespace {

constexpr float kSeenEnough = 0.25F;  // confidence
constexpr size_t kLeastPoints = 8;    // of a person, visible to both cameras

// Errors of a network's point, share of the person's height: independent from moment to moment, and
// constant for the side from which the walk is seen, because it takes a joint where it seems to be
// from there. These are about the distances of MoveNet's points from the rays of two telephones.
constexpr double kPointSd = 0.01, kSideSd = 0.01;
// Points of the face, of which one or two are hidden from the side, have errors this many times as
// large.
constexpr double kFaceSd = 2;
constexpr size_t kFacePoints = 5;
// Relative variation of a bone's length from moment to moment, because joints are inside the body
// and detected on its outline. By hand; bones have half weight, because they consist of the same
// points.
constexpr double kBoneSd = 0.08, kBoneWeight = 0.5;
// Errors of a network depend on the pose: images that are nearer in time than this are not
// independent, s.
constexpr double kIndependent_s = 0.25;
// Recordings are started by hand at a sign or by one program; longer lags have to be cut by the
// user.
constexpr double kLagSd_s = 0.1;
// Residuals in standard deviations: the limit for points that cannot be right, and that for
// outliers.
constexpr double kFarOff = 100, kOutlier = 10;

enum Unknown : Eigen::Index {
  kLogFocal,                   // of both cameras, logarithms of the ratio to the assumed one
  kRotation = kLogFocal + 2,   // of the second camera relative to the first, rotation vector
  kDirection = kRotation + 3,  // of the first camera as seen from the second: two angles
  kLag = kDirection + 2,
  kUnknowns
};

constexpr std::array<std::array<KeypointName, 2>, 6> kBones{
    {{KeypointName::kLeftHip, KeypointName::kLeftKnee},
     {KeypointName::kRightHip, KeypointName::kRightKnee},
     {KeypointName::kLeftKnee, KeypointName::kLeftAnkle},
     {KeypointName::kRightKnee, KeypointName::kRightAnkle},
     {KeypointName::kLeftShoulder, KeypointName::kLeftHip},
     {KeypointName::kRightShoulder, KeypointName::kRightHip}}};

Vector2d pixel(const Keypoint& point) { return {point.x_px, point.y_px}; }

double height_px(const DetectedPerson& person) {
  float top = person.points[0].y_px, bottom = top;
  for (size_t i = 1; i < kSharedPoints; ++i) {
    top = std::min(top, person.points[i].y_px);
    bottom = std::max(bottom, person.points[i].y_px);
  }
  return bottom - top;
}

std::optional<SharedMoment> shared(const SeenMoment& seen, std::span<const SeenMoment> second) {
  const auto after =
      std::lower_bound(second.begin(), second.end(), seen.time,
                       [](const SeenMoment& moment, double time) { return moment.time < time; });
  if (after == second.end()) return std::nullopt;
  const auto near =
      after != second.begin() && seen.time - (after - 1)->time < after->time - seen.time ? after - 1
                                                                                         : after;
  if (std::abs(near->time - seen.time) > kIndependent_s) return std::nullopt;
  SharedMoment out{seen.time,
                   static_cast<size_t>(near - second.begin()),
                   {},
                   {},
                   {height_px(seen.person), height_px(near->person)}};
  size_t both = 0;
  for (size_t i = 0; i < kSharedPoints; ++i) {
    out.first[i] = pixel(seen.person.points[i]);
    out.seen[i] =
        std::min(seen.person.points[i].confidence, near->person.points[i].confidence) > kSeenEnough;
    both += out.seen[i];
  }
  const bool enough = both >= kLeastPoints && std::min(out.size_px[0], out.size_px[1]) >= 1;
  return enough ? std::optional(out) : std::nullopt;
}

Vector2d middle_of(const LensAssumption& lens) {
  return {0.5 * (lens.width_px - 1), 0.5 * (lens.height_px - 1)};
}

Vector3d ray_of(const Vector2d& at, const LensAssumption& lens, double focal_px) {
  return Vector2d((at - middle_of(lens)) / focal_px).homogeneous();
}

// Its square grows quadratically for small residuals and linearly for large ones (Charbonnier
// 1997).
double robust(double miss) {
  return std::copysign(std::sqrt(2 * (std::sqrt(1 + 0.5 * miss * miss) - 1)), miss);
}

}  // namespace

std::vector<SharedMoment> shared_moments(std::span<const SeenMoment> first,
                                         std::span<const SeenMoment> second) {
  std::vector<SharedMoment> out;
  if (second.size() < 2) return out;
  for (const SeenMoment& seen : first)
    if (const auto moment = shared(seen, second)) out.push_back(*moment);
  return out;
}

std::vector<SharedMoment> thinned(const std::vector<SharedMoment>& moments, size_t most) {
  std::vector<SharedMoment> out;
  const size_t count = std::min(most, moments.size());
  for (size_t i = 0; i < count; ++i) out.push_back(moments[i * moments.size() / count]);
  return out;
}

// The nearest points of two rays, in the first camera's axes.
struct WalkerRays::Meeting {
  Vector3d point;
  bool ahead;  // whether it is in front of both cameras
  bool above;  // whether the first ray passes on one side of the second one, or on the other
};

WalkerRays::WalkerRays(std::vector<SharedMoment> moments, std::span<const SeenMoment> second,
                       const TwoViewAssumptions& given)
    : moments_(std::move(moments)), second_(second), given_(given) {
  const double apart = (moments_.back().time - moments_.front().time) /
                       static_cast<double>(std::max<size_t>(1, moments_.size() - 1));
  weight_ = std::sqrt(std::min(1.0, apart / kIndependent_s));
}

CameraPair WalkerRays::pair(const VectorXd& x) const {
  const Vector3d turn = x.segment<3>(kRotation);
  const double angle = turn.norm();
  const double azimuth = x[kDirection], elevation = x[kDirection + 1];
  return {{given_.lenses[0].focal_px * std::exp(x[kLogFocal]),
           given_.lenses[1].focal_px * std::exp(x[kLogFocal + 1])},
          angle > 0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix()
                    : Matrix3d(Matrix3d::Identity()),
          {std::cos(elevation) * std::cos(azimuth), std::sin(elevation),
           std::cos(elevation) * std::sin(azimuth)},
          x[kLag]};
}

// Interpolated linearly between two frames.
Vector2d WalkerRays::second_at(const SharedMoment& moment, size_t point, double lag) const {
  const double time = moment.time + lag;
  size_t k = moment.second;
  while (k > 0 && second_[k].time > time) --k;
  while (k + 2 < second_.size() && second_[k + 1].time < time) ++k;
  k = std::min(k, second_.size() - 2);
  const double share =
      std::clamp((time - second_[k].time) / (second_[k + 1].time - second_[k].time), 0.0, 1.0);
  return (1 - share) * pixel(second_[k].person.points[point]) +
         share * pixel(second_[k + 1].person.points[point]);
}

WalkerRays::Meeting WalkerRays::meeting(const SharedMoment& moment, size_t point,
                                        const CameraPair& pair) const {
  const Vector3d first = pair.second_from_first *
                         ray_of(moment.first[point], given_.lenses[0], pair.focal_px[0]),
                 second =
                     ray_of(second_at(moment, point, pair.lag), given_.lenses[1], pair.focal_px[1]);
  const double aa = first.squaredNorm(), bb = second.squaredNorm(), ab = first.dot(second),
               at = first.dot(pair.translation), bt = second.dot(pair.translation);
  const double parallel = std::max(aa * bb - ab * ab, 1e-12);
  const double along = (ab * bt - bb * at) / parallel,
               along_second = (aa * bt - ab * at) / parallel;
  const Vector3d middle = 0.5 * (along * first + pair.translation + along_second * second);
  return {pair.second_from_first.transpose() * (middle - pair.translation),
          along > 0 && along_second > 0, pair.translation.dot(first.cross(second)) > 0};
}

// In standard deviations, over both images; the sign states which ray passes above the other.
double WalkerRays::miss(const SharedMoment& moment, size_t point, const CameraPair& pair) const {
  const Meeting met = meeting(moment, point, pair);
  const Vector3d second = pair.second_from_first * met.point + pair.translation;
  if (std::min(std::abs(met.point.z()), std::abs(second.z())) < 1e-9) return kFarOff;
  const auto off = [&](size_t camera, const Vector3d& from, const Vector2d& seen) {
    const Vector2d at =
        pair.focal_px[camera] * from.hnormalized() + middle_of(given_.lenses[camera]);
    return (at - seen).norm() / (kPointSd * moment.size_px[camera]);
  };
  const double both = std::hypot(off(0, met.point, moment.first[point]),
                                 off(1, second, second_at(moment, point, pair.lag)));
  return std::copysign(std::min(kFarOff, both), met.above ? 1.0 : -1.0);
}

std::vector<BodyPoints> WalkerRays::bodies(const CameraPair& pair) const {
  std::vector<BodyPoints> out(moments_.size());
  for (size_t m = 0; m < moments_.size(); ++m)
    for (size_t i = 0; i < kSharedPoints; ++i) out[m][i] = meeting(moments_[m], i, pair).point;
  return out;
}

double WalkerRays::ahead(const CameraPair& pair) const {
  double ahead = 0, all = 0;
  for (const SharedMoment& moment : moments_)
    for (size_t i = 0; i < kSharedPoints; ++i) {
      if (!moment.seen[i]) continue;
      ahead += meeting(moment, i, pair).ahead;
      ++all;
    }
  return ahead / all;
}

double WalkerRays::rms(const CameraPair& pair) const {
  double sum = 0, all = 0;
  for (const SharedMoment& moment : moments_)
    for (size_t i = 0; i < kSharedPoints; ++i) {
      if (!moment.seen[i]) continue;
      sum += std::pow(std::min(kOutlier, std::abs(miss(moment, i, pair))), 2);
      all += 2;
    }
  return kPointSd * std::sqrt(sum / all);
}

// By moment, in standard deviations from the median length; 0 if an end was not detected.
std::vector<double> WalkerRays::bone_misses(const std::vector<BodyPoints>& bodies,
                                            KeypointName from, KeypointName to) const {
  const auto seen = [&](size_t m) {
    return moments_[m].seen[static_cast<size_t>(from)] && moments_[m].seen[static_cast<size_t>(to)];
  };
  std::vector<double> out(bodies.size()), known;
  for (size_t m = 0; m < bodies.size(); ++m) {
    out[m] = std::log(std::max(1e-9, (point_of(bodies[m], from) - point_of(bodies[m], to)).norm()));
    if (seen(m)) known.push_back(out[m]);
  }
  const double usual = known.empty() ? 0 : median_of(known);
  for (size_t m = 0; m < bodies.size(); ++m) out[m] = seen(m) ? (out[m] - usual) / kBoneSd : 0;
  return out;
}

// Adds the residuals of one point by moment, and their common part.
void WalkerRays::add_point(size_t point, const CameraPair& pair, VectorXd& out,
                           Eigen::Index& at) const {
  const double sd = point < kFacePoints ? kFaceSd : 1;
  double sum = 0, count = 0;
  std::vector<double> misses;
  for (const SharedMoment& moment : moments_) {
    if (!moment.seen[point]) continue;
    misses.push_back(miss(moment, point, pair) / sd);
    sum += std::clamp(misses.back(), -kOutlier, kOutlier);
    ++count;
  }
  const double common = count > 0 ? sum / count : 0;
  for (size_t m = 0; m < misses.size(); ++m)
    out[at + static_cast<Eigen::Index>(m)] = weight_ * robust(misses[m] - common);
  at += static_cast<Eigen::Index>(moments_.size());
  if (count > 0)
    out[at] = common / std::sqrt(std::pow(kSideSd / kPointSd, 2) + 1 / (weight_ * weight_ * count));
  ++at;
}

VectorXd WalkerRays::residuals(const VectorXd& x) const {
  const CameraPair pair = this->pair(x);
  const auto count =
      static_cast<Eigen::Index>(moments_.size() * (kSharedPoints + kBones.size()) + kSharedPoints);
  VectorXd out = VectorXd::Zero(count + 3);
  Eigen::Index at = 0;
  for (size_t i = 0; i < kSharedPoints; ++i) add_point(i, pair, out, at);
  const std::vector<BodyPoints> bodies = this->bodies(pair);
  for (const auto& [from, to] : kBones)
    for (const double miss : bone_misses(bodies, from, to))
      out[at++] = kBoneWeight * weight_ * robust(miss);
  for (size_t camera = 0; camera < 2; ++camera) {
    const LensAssumption& lens = given_.lenses[camera];
    out[at++] = x[kLogFocal + static_cast<Eigen::Index>(camera)] /
                std::max(1e-6, lens.focal_sd / lens.focal_px);
  }
  out[at] = x[kLag] / kLagSd_s;
  return out;
}

// Position of the person, in units of their height, from the middle and the size of their points.
Vector3d WalkerRays::mean_place(size_t camera) const {
  const LensAssumption& lens = given_.lenses[camera];
  std::vector<double> x, y, far;
  for (const SharedMoment& moment : moments_) {
    far.push_back(lens.focal_px / moment.size_px[camera]);
    for (size_t i = 0; i < kSharedPoints; ++i) {
      const Vector3d ray =
          ray_of(camera == 0 ? moment.first[i] : second_at(moment, i, 0), lens, lens.focal_px);
      x.push_back(ray.x());
      y.push_back(ray.y());
    }
  }
  return median_of(far) * Vector3d(median_of(x), median_of(y), 1);
}

VectorXd WalkerRays::start(double turn) const {
  const Eigen::AngleAxisd rotation(turn, Vector3d::UnitY());
  const Vector3d direction = (mean_place(1) - rotation * mean_place(0)).normalized();
  VectorXd x = VectorXd::Zero(kUnknowns);
  x.segment<3>(kRotation) = turn * Vector3d::UnitY();
  x[kDirection] = std::atan2(direction.z(), direction.x());
  x[kDirection + 1] = std::asin(std::clamp(direction.y(), -1.0, 1.0));
  return x;
}

LeastSquaresFit WalkerRays::adjusted(const VectorXd& start) const {
  return minimise_squares([this](const VectorXd& x) { return residuals(x); }, start);
}

}  // namespace observation
}  // namespace walktrack
