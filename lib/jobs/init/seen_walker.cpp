#include "jobs/init/seen_walker.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "core/parallel_for.h"
#include "io/archive/files.h"
#include "io/video/video.h"
#include "jobs/init/figure_tracks.h"
#include "jobs/track/input/person_finder.h"
#include "jobs/track/input/pose_model.h"
#include "observation/background/background_sampler.h"
#include "observation/figures/whole_figure.h"
#include "observation/image.h"

namespace walktrack {
inline namespace jobs {

namespace {

constexpr int kWorkingSide_px = 960;  // longer side of the shrunk image, in which a person is 100
                                      // px high or more
constexpr double kLooks_hz = 10;      // rate of the frames that are searched
constexpr size_t kMostFrames = 600;   // with somebody in them
// Duration of a stride in ordinary walking, and the relative range of the figure's height within
// one.
constexpr double kStride_s = 1.1, kUnequal = 0.08;

int shrink_of(const VideoFacts& facts) {
  const int side = std::max(facts.width_px, facts.height_px);
  return (side + kWorkingSide_px - 1) / kWorkingSide_px;
}

BackgroundModel background_of(const InitJob& job, PixelSize size, int shrink, int threads,
                              const JobControl& control) {
  FrameSource source(job.background.empty() ? job.video : job.background, size);
  BackgroundSampler sampler({});
  const auto total = static_cast<size_t>(source.facts().frame_count);
  Image frame;
  for (size_t done = 0; source.advance(); ++done) {
    if (sampler.takes_next()) {
      source.picture(shrink, frame);
      sampler.take(frame);
    }
    control.progress("learning the background", done, total);
    if (control.stopping()) break;
  }
  return sampler.model(threads);
}

// Finds figures that are completely visible in one frame.
class FigureFinder {
 public:
  FigureFinder(const VideoFacts& facts, int shrink) : shrink_(shrink) {
    const auto file = has_pose_net() ? pose_model_file(std::string(kShippedModel)) : std::nullopt;
    if (!file) return;
    net_.emplace(read_text_file(*file, kMaxModelBytes), file->string());
    people_.emplace(facts.width_px, facts.height_px, 0.4 * facts.height_px);
  }

  std::vector<SeenFigure> in(const Image& frame, const Image& mask, int number) {
    std::vector<SeenFigure> found;
    const auto add = [&](const WholeFigure& figure) {
      found.push_back({0, 0, 0, figure.u_px, figure.top_px, figure.bottom_px});
    };
    if (net_) {
      for (const DetectedPerson& person : people_->look(*net_, frame, number))
        if (const auto figure = whole_figure_of(person, mask, shrink_)) add(*figure);
    } else {
      for (const WholeFigure& figure : whole_figures(mask, shrink_)) add(figure);
    }
    return found;
  }

 private:
  int shrink_;
  std::optional<PoseNet> net_;
  std::optional<PersonFinder> people_;
};

std::optional<WalkerPosition> mean_of(std::span<const SeenFigure> figures, size_t least) {
  if (figures.size() < least) return std::nullopt;
  const double usual = median_size({figures.begin(), figures.end()});
  SeenStature sum{0, 0, 0};
  double count = 0, time = 0;
  for (const SeenFigure& figure : figures) {
    if (std::abs(size_of(figure) / usual - 1) > kUnequal) continue;
    sum.u_px += figure.u_px;
    sum.top_px += figure.top_px;
    sum.bottom_px += figure.bottom_px;
    time += figure.time;
    ++count;
  }
  if (count < static_cast<double>(least)) return std::nullopt;
  return WalkerPosition{{sum.u_px / count, sum.top_px / count, sum.bottom_px / count},
                        time / count};
}

}  // namespace

SeenWalk seen_walk(const InitJob& job, const JobControl& control) {
  FrameSource source(job.video);
  const VideoFacts facts = source.facts();
  SeenWalk out{facts.width_px, facts.height_px, job.frame_rate.value_or(facts.frame_rate), 0, {}};
  if (out.frame_rate <= 0)
    throw InputError(
        describe({job.video.string(), 0, ""}, "no frame rate", "images with --frame-rate HZ"));
  const int shrink = shrink_of(facts), threads = thread_count(job.threads);
  ForegroundMask foreground(
      facts.width_px, facts.height_px,
      background_of(job, {facts.width_px, facts.height_px}, shrink, threads, control), shrink,
      threads);
  FigureFinder finder(facts, shrink);
  const int every = std::max(1, static_cast<int>(std::lround(out.frame_rate / kLooks_hz)));
  out.looks_hz = out.frame_rate / every;
  Image frame, small;
  std::vector<FigureTrack> tracks;
  size_t looked = 0;
  for (int n = 0; looked < kMostFrames && !control.stopping() && source.advance(); ++n) {
    control.progress("looking for the subject", static_cast<size_t>(n),
                     static_cast<size_t>(facts.frame_count));
    if (n % every != 0) continue;
    source.picture(frame);
    source.picture(shrink, small);
    std::vector<SeenFigure> figures = finder.in(frame, foreground.of(small), n / every);
    looked += !figures.empty();
    for (SeenFigure& figure : figures) {
      figure.frame = n;
      figure.time = n / out.frame_rate;
      link(figure, tracks);
    }
  }
  out.figures = walker_of(tracks, way_across);
  return out;
}

std::vector<WalkerPosition> stride_positions(std::span<const SeenFigure> figures, double looks_hz) {
  std::vector<WalkerPosition> out;
  const auto least = static_cast<size_t>(std::max(3L, std::lround(0.6 * kStride_s * looks_hz)));
  for (size_t from = 0; from < figures.size();) {
    size_t to = from;
    while (to < figures.size() && figures[to].time < figures[from].time + kStride_s) ++to;
    const auto position = mean_of(figures.subspan(from, to - from), least);
    if (position) out.push_back(*position);
    // Windows overlap by half.
    const double next = figures[from].time + 0.5 * kStride_s;
    while (from < figures.size() && figures[from].time < next) ++from;
  }
  return out;
}

}  // namespace jobs
}  // namespace walktrack
