#include "observation/two_views/pair_lag.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>

#include "observation/two_views/step_time.h"

namespace walktrack {
inline namespace observation {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();
constexpr double kLongestLag = 1;    // s
constexpr double kShortestPart = 1;  // s; least duration before and after a change of the lag
constexpr double kMostLost = 0.5;    // s; longest run of missing frames
constexpr double kMoment = 0.25;     // s; frames nearer to each other have common errors
constexpr double kNearLine = 0.15;   // sine of the angle to the line through both cameras
constexpr double kEndNoise = 0.01;   // m, noise of an outline's end
constexpr double kMostBias = 0.02;   // m, by which one camera sees ends higher than the other
constexpr double kAgreement = 0.3;   // least share of frames that agree if cameras are
                                     // synchronous
constexpr double kDistinct = 0.1;    // and its least excess over other lags,
constexpr double kPeak = 0.1;        // s; other lags are at least so far away
constexpr size_t kFewest = 20;       // frames
constexpr int kLeastLag = 2;         // frames
constexpr double kQuickStep = 0.4;   // s; walking steps take longer
constexpr double kClear = 3;         // standard errors
constexpr double kLeastGain = 0.08;  // least increase of that share

// The planes that contain the line through both cameras.
struct Pencil {
  Vector3d up, aside;  // unit vectors at right angles to that line; up as far as possible
};

// nullopt if one camera is above the other.
std::optional<Pencil> pencil_of(const Camera& a, const Camera& b) {
  const Vector3d line = (camera_centre(b) - camera_centre(a)).stableNormalized();
  const Vector3d up = Vector3d::UnitZ() - line.z() * line;
  if (!(up.norm() > 0.5)) return std::nullopt;
  return Pencil{up.normalized(), line.cross(up.normalized())};
}

// The slope of the plane through a pixel relative to the line through both cameras; NaN near that
// line.
double slope(const Camera& camera, const Pencil& pencil, const Vector2d& pixel) {
  const auto ray = unproject(camera, pixel);
  const double aside = ray ? std::abs(ray->direction.dot(pencil.aside)) : 0;
  return aside > kNearLine ? ray->direction.dot(pencil.up) / aside : kNan;
}

// The steepest one or, with -1, the least steep one; NaN if one of them is unknown.
double steepest(const Camera& camera, const Pencil& pencil, const std::vector<Vector2d>& pixels,
                double sign) {
  double most = -std::numeric_limits<double>::infinity();
  for (const Vector2d& pixel : pixels) {
    const double each = sign * slope(camera, pencil, pixel);
    if (!std::isfinite(each)) return kNan;
    most = std::max(most, each);
  }
  return pixels.empty() ? kNan : sign * most;
}

// By frame: the slopes of the planes that touch the figure's head and its feet.
enum OutlineEnd : size_t { kTop, kBottom, kEnds };
using Heights = std::array<std::vector<double>, kEnds>;

Heights heights_of(const Camera& camera, const Pencil& pencil, const FigurePath& path) {
  Heights out;
  for (const auto& figure : path) {
    out[kTop].push_back(figure ? steepest(camera, pencil, figure->tops, 1) : kNan);
    out[kBottom].push_back(figure ? steepest(camera, pencil, figure->bottoms, -1) : kNan);
  }
  return out;
}

double median(std::vector<double> values) {
  if (values.empty()) return kNan;
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

// Usual distance of the figure from the line through both cameras, m, which converts slopes to
// heights.
double usual_distance(const Camera& camera, const Pencil& pencil, const FigurePath& path) {
  std::vector<double> distances;
  for (const auto& figure : path) {
    if (!figure || figure->bottoms.empty()) continue;
    const auto lower = [](const Vector2d& a, const Vector2d& b) { return a.y() < b.y(); };
    const auto foot = ground_point(
        camera, *std::max_element(figure->bottoms.begin(), figure->bottoms.end(), lower));
    if (foot) distances.push_back(std::abs((*foot - camera_centre(camera)).dot(pencil.aside)));
  }
  return median(std::move(distances));
}

// By frame of the first camera: how well an end agrees with the second camera's so many frames
// later, 0 to 1; NaN if one of them is unknown.
using Agreement = std::vector<double>;

Agreement agreement(const std::vector<double>& first, const std::vector<double>& second, int lag,
                    double distance) {
  Agreement out(first.size(), kNan);
  std::vector<double> known;
  for (int t = 0; t < std::ssize(first); ++t) {
    const int other = t + lag;
    if (other < 0 || other >= std::ssize(second)) continue;
    const auto at = static_cast<size_t>(t);
    out[at] = distance * (first[at] - second[static_cast<size_t>(other)]);
    if (std::isfinite(out[at])) known.push_back(out[at]);
  }
  if (known.size() < kFewest) return Agreement(first.size(), kNan);
  const double bias = std::clamp(median(std::move(known)), -kMostBias, kMostBias);
  for (double& each : out) each = std::exp(-0.5 * std::pow((each - bias) / kEndNoise, 2));
  return out;
}

double mean(const Agreement& values) {
  double sum = 0;
  int count = 0;
  for (const double each : values) {
    if (!std::isfinite(each)) continue;
    sum += each;
    ++count;
  }
  return count > 0 ? sum / count : 0;
}

// The agreement of one end at all lags, from -longest to longest.
using ByLag = std::vector<Agreement>;

// Whether an end is usable: it agrees at some lag, better than at most other lags, and better than
// slightly before and after it. If a shadow replaces the feet, or a camera misses the head, ends
// that do not correspond agree by chance over a wide range of lags.
bool is_usable(const ByLag& end, size_t little) {
  std::vector<double> means;
  for (const Agreement& each : end) means.push_back(mean(each));
  const auto found = std::max_element(means.begin(), means.end());
  const auto place = static_cast<size_t>(found - means.begin());
  const double best = *found;
  double beside = place >= little ? means[place - little] : 0;
  if (place + little < means.size()) beside = std::max(beside, means[place + little]);
  return best >= kAgreement && best - beside >= kDistinct &&
         best - median(std::move(means)) >= kDistinct;
}

// Both ends of a frame as one number each: 0 if neither is known and usable.
struct Sums {
  std::vector<double> sum, count;  // by frame
  double mean() const;
};

double total(const std::vector<double>& values) {
  double sum = 0;
  for (const double each : values) sum += each;
  return sum;
}

double Sums::mean() const {
  const double counted = total(count);
  return counted >= kFewest ? total(sum) / counted : 0;
}

Sums sums_at(const std::vector<ByLag>& ends, size_t lag, size_t frames) {
  Sums out{std::vector<double>(frames), std::vector<double>(frames)};
  for (const ByLag& end : ends) {
    for (size_t t = 0; t < frames; ++t) {
      if (!std::isfinite(end[lag][t])) continue;
      out.sum[t] += end[lag][t];
      out.count[t] += 1;
    }
  }
  return out;
}

// The mean difference of agreement between two hypotheses, and its ratio to the standard error
// between moments. Only frames that both have are counted.
struct Gain {
  double mean = 0, clear = 0;
};

Gain gain(const Sums& account, const Sums& other, size_t moment) {
  std::vector<std::pair<double, double>> moments;  // sums and counts
  for (size_t t = 0; t < account.sum.size(); ++t) {
    if (t % moment == 0) moments.emplace_back(0, 0);
    if (account.count[t] == 0 || account.count[t] != other.count[t]) continue;
    moments.back().first += account.sum[t] - other.sum[t];
    moments.back().second += account.count[t];
  }
  double sum = 0, count = 0, variance = 0;
  for (const auto& [s, c] : moments) {
    sum += s;
    count += c;
  }
  if (count < kFewest) return {};
  for (const auto& [s, c] : moments) variance += std::pow(s - sum / count * c, 2);
  return {sum / count, variance > 0 ? sum / std::sqrt(variance) : 0};
}

// The best hypothesis with one change of lag: maximises running sums relative to the best constant
// lag.
struct Change {
  size_t at = 0, before = 0, after = 0;  // frame, and indices in the list of lags
};

Change best_change(const std::vector<Sums>& lags, double usual, size_t shortest) {
  const size_t frames = lags[0].sum.size();
  std::vector<std::vector<double>> running(lags.size(), std::vector<double>(frames + 1));
  for (size_t l = 0; l < lags.size(); ++l)
    for (size_t t = 0; t < frames; ++t)
      running[l][t + 1] = running[l][t] + lags[l].sum[t] - usual * lags[l].count[t];
  Change best;
  double most = -std::numeric_limits<double>::infinity();
  for (size_t t = shortest; t + shortest <= frames; ++t) {
    Change here{t, 0, 0};
    const auto rest = [&](size_t l) { return running[l][frames] - running[l][t]; };
    for (size_t l = 1; l < lags.size(); ++l) {
      if (running[l][t] > running[here.before][t]) here.before = l;
      if (rest(l) > rest(here.after)) here.after = l;
    }
    const double value = running[here.before][t] + rest(here.after);
    if (value <= most) continue;
    most = value;
    best = here;
  }
  return best;
}

// Copies the frames [from, to) of one hypothesis.
void copy_part(const Sums& whole, size_t from, size_t to, Sums& out) {
  const auto b = std::ptrdiff_t(from), e = std::ptrdiff_t(to);
  std::copy(whole.sum.begin() + b, whole.sum.begin() + e, out.sum.begin() + b);
  std::copy(whole.count.begin() + b, whole.count.begin() + e, out.count.begin() + b);
}

// Before the change at one lag, and from then on at another one.
Sums changing(const std::vector<Sums>& lags, const Change& change) {
  const size_t frames = lags[0].sum.size();
  Sums out{std::vector<double>(frames), std::vector<double>(frames)};
  copy_part(lags[change.before], 0, change.at, out);
  copy_part(lags[change.after], change.at, frames, out);
  return out;
}

// For each frame, the best agreement at any other lag than the overall best.
Sums otherwise(const std::vector<Sums>& lags, const Change& change, size_t best) {
  const size_t frames = lags[0].sum.size();
  Sums out{std::vector<double>(frames), std::vector<double>(frames)};
  if (change.before != best) copy_part(lags[change.before], 0, change.at, out);
  if (change.after != best) copy_part(lags[change.after], change.at, frames, out);
  return out;
}

size_t best_lag(const std::vector<Sums>& lags) {
  return static_cast<size_t>(
      std::max_element(lags.begin(), lags.end(),
                       [](const Sums& a, const Sums& b) { return a.mean() < b.mean(); }) -
      lags.begin());
}

bool is_clear(const Gain& gain) { return gain.mean >= kLeastGain && gain.clear >= kClear; }

// Standard deviation of the best lag, frames: lags that are worse by less than a standard error are
// as likely, and a lag is an integer number of frames.
double lag_sd(const std::vector<Sums>& lags, size_t best, size_t moment) {
  const auto as_likely = [&](size_t l) { return gain(lags[best], lags[l], moment).clear < 1; };
  size_t first = best, last = best;
  while (first > 0 && as_likely(first - 1)) --first;
  while (last + 1 < lags.size() && as_likely(last + 1)) ++last;
  return static_cast<double>(last - first + 1) / std::sqrt(12.0);
}

// Whether a lag is a multiple of the step time, measured in the camera and at the end that show it
// best.
bool may_be_steps(const std::vector<Camera>& cameras, const std::vector<FigurePath>& paths,
                  double lag, double frame_rate) {
  const auto pencil = pencil_of(cameras[0], cameras[1]);
  std::optional<double> step;
  for (size_t i = 0; pencil && !step && i < cameras.size(); ++i)
    step = step_time(heights_of(cameras[i], *pencil, paths[i])[kTop], frame_rate);
  const double time = std::abs(lag) / frame_rate;
  return step ? is_whole_steps(time, *step) : time >= kQuickStep;
}

// All lags from -longest to longest; empty if neither end is usable. `little`: see is_usable().
std::vector<Sums> lags_tried(const std::vector<Camera>& cameras,
                             const std::vector<FigurePath>& paths, int longest, int little) {
  const auto pencil = pencil_of(cameras[0], cameras[1]);
  if (!pencil) return {};
  const Heights first = heights_of(cameras[0], *pencil, paths[0]),
                second = heights_of(cameras[1], *pencil, paths[1]);
  const double distance = usual_distance(cameras[0], *pencil, paths[0]);
  std::vector<ByLag> ends;
  for (const OutlineEnd end : {kTop, kBottom}) {
    ByLag lags;
    for (int lag = -longest; lag <= longest; ++lag)
      lags.push_back(agreement(first[end], second[end], lag, distance));
    if (is_usable(lags, static_cast<size_t>(little))) ends.push_back(std::move(lags));
  }
  std::vector<Sums> out;
  for (size_t l = 0; !ends.empty() && l < ends[0].size(); ++l)
    out.push_back(sums_at(ends, l, paths[0].size()));
  return out;
}

}  // namespace

std::optional<PairLag> find_pair_lag(const std::vector<Camera>& cameras,
                                     const std::vector<FigurePath>& paths, double frame_rate) {
  const auto frames_in = [&](double seconds) {
    return static_cast<int>(std::max(2L, std::lround(seconds * frame_rate)));
  };
  const int longest = frames_in(kLongestLag);
  const std::vector<Sums> lags = lags_tried(cameras, paths, longest, frames_in(kPeak));
  if (lags.empty()) return std::nullopt;
  const auto lag_of = [&](size_t place) { return static_cast<int>(place) - longest; };
  const auto apart = [&](size_t a, size_t b) {
    return std::abs(lag_of(a) - lag_of(b)) >= kLeastLag;
  };
  const size_t best = best_lag(lags), none = static_cast<size_t>(longest);
  const auto moment = static_cast<size_t>(frames_in(kMoment));
  const int most_lost = frames_in(kMostLost);
  const Change change =
      best_change(lags, lags[best].mean(), static_cast<size_t>(frames_in(kShortestPart)));
  const bool lost = apart(change.before, change.after) &&
                    std::abs(lag_of(change.before) - lag_of(change.after)) <= most_lost;
  if (lost && is_clear(gain(otherwise(lags, change, best), lags[best], moment)))
    return PairLag{.before = lag_of(change.before),
                   .after = lag_of(change.after),
                   .changes_at = static_cast<int>(change.at),
                   .agreement = changing(lags, change).mean()};
  if (!apart(best, none) || !is_clear(gain(lags[best], lags[none], moment))) return PairLag{};
  return PairLag{.before = lag_of(best),
                 .after = lag_of(best),
                 .sd = lag_sd(lags, best, moment),
                 .may_be_steps = may_be_steps(cameras, paths, lag_of(best), frame_rate)};
}

}  // namespace observation
}  // namespace walktrack
