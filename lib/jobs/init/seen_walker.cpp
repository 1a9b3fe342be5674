#include "jobs/init/seen_walker.h"

#include <algorithm>
#include <cmath>

#include <opencv2/imgproc.hpp>

#include "core/errors.h"
#include "core/parallel_for.h"
#include "io/archive/files.h"
#include "io/video/video.h"
#include "jobs/init/figure_tracks.h"
#include "jobs/track/input/person_finder.h"
#include "jobs/track/input/pose_model.h"
#include "observation/background/background_sampler.h"
#include "observation/observer.h"
#include "observation/shrink.h"

namespace walktrack {
inline namespace jobs {

namespace {

constexpr int kWorkingSide_px = 960;  // of the shrunk image: a person is 100 px high or more
constexpr double kLooks_hz = 10;      // frames looked at in a second
constexpr size_t kMostFrames = 600;   // at frames with somebody in them
constexpr double kLeastHeight = 0.08, kMostHeight = 0.98;  // of the figure, shares of the picture
constexpr double kWidest = 1.2;                            // a walker is higher than wide
// Beyond the points of a head and an ankle, shares of the way between them.
constexpr double kAboveHead = 0.17, kBelowAnkle = 0.10, kBeside = 0.2;
// Of the height in which a person is looked for: pieces that are more than specks, and how much of
// it a whole person fills.
constexpr double kLeastPiece = 0.04, kLeastCovered = 0.72;
constexpr float kSeenEnough = 0.25F;
// A stride of ordinary walking, and how unequal in height its frames may be.
constexpr double kStride_s = 1.1, kUnequal = 0.08;

// A camera as good as any: only the size of its pictures matters here.
Camera plain_camera(const VideoFacts& facts) {
  Camera camera;
  camera.width_px = facts.width_px;
  camera.height_px = facts.height_px;
  camera.focal_px = {1.0 * facts.width_px, 1.0 * facts.width_px};
  camera.centre_px = {0.5 * facts.width_px, 0.5 * facts.height_px};
  return camera;
}

int shrink_of(const VideoFacts& facts) {
  const int side = std::max(facts.width_px, facts.height_px);
  return (side + kWorkingSide_px - 1) / kWorkingSide_px;
}

BackgroundModel background_of(const InitJob& job, cv::Size size, int shrink, int threads,
                              const JobControl& control) {
  FrameSource source(job.background.empty() ? job.video : job.background, size);
  BackgroundSampler sampler({}, shrink);
  const auto total = static_cast<size_t>(source.facts().frame_count);
  cv::Mat frame;
  for (size_t done = 0; source.read(frame); ++done) {
    sampler.add(frame);
    control.progress("learning the background", done, total);
    if (control.stopping()) break;
  }
  return sampler.model(threads);
}

class Foreground {
 public:
  Foreground(const VideoFacts& facts, BackgroundModel background, int shrink, int threads)
      : observer_(config(), input(facts, std::move(background), shrink, threads)) {}

  // 255 where the picture does not look like the background; shrunk.
  cv::Mat of(const cv::Mat& frame) {
    observer_.observe(frame, whole_image(observer_.camera(), 0.01), evidence_);
    const LogRatioPlanes& planes = evidence_.planes;
    cv::Mat mask(observer_.camera().height_px, observer_.camera().width_px, CV_8U);
    for (int y = 0; y < mask.rows; ++y)
      for (int x = 0; x < mask.cols; ++x)
        mask.at<uchar>(y, x) = log_ratio_at(planes, Appearance::kTrunk, x, y) > 0 ? 255 : 0;
    cv::morphologyEx(mask, mask, cv::MORPH_OPEN, cv::Mat::ones(2, 2, CV_8U));
    cv::morphologyEx(mask, mask, cv::MORPH_CLOSE, cv::Mat::ones(7, 3, CV_8U));
    return mask;
  }

 private:
  static ObservationConfig config() {
    ObservationConfig out;
    out.foreground.enabled = false;
    out.flow.enabled = TermSetting::kOff;
    out.keypoints.enabled = TermSetting::kOff;
    return out;
  }
  static ObserverInput input(const VideoFacts& facts, BackgroundModel background, int shrink,
                             int threads) {
    ObserverInput out;
    out.camera = plain_camera(facts);
    out.shrink = shrink;
    out.appearances[static_cast<size_t>(Appearance::kTrunk)] = true;
    out.background = std::move(background);
    out.threads = threads;
    return out;
  }
  Observer observer_;
  CameraEvidence evidence_;
};

// A connected part of the foreground, px of the shrunk image.
struct Part {
  cv::Rect box;
  cv::Mat mask;  // of the box
};

// Those that are at least so high.
std::vector<Part> parts_of(const cv::Mat& mask, double least_px) {
  cv::Mat labels, statistics, centres;
  const int count = cv::connectedComponentsWithStats(mask, labels, statistics, centres);
  std::vector<Part> parts;
  for (int i = 1; i < count; ++i) {
    const auto at = [&](int column) { return statistics.at<int>(i, column); };
    const cv::Rect box(at(cv::CC_STAT_LEFT), at(cv::CC_STAT_TOP), at(cv::CC_STAT_WIDTH),
                       at(cv::CC_STAT_HEIGHT));
    if (box.height >= least_px) parts.push_back({box, labels(box) == i});
  }
  return parts;
}

// The box in which a detected person can be, px of the picture; nothing without head and ankles.
std::optional<cv::Rect> box_of(const DetectedPerson& person) {
  using enum KeypointName;
  double top = 1e9, bottom = -1e9, left = 1e9, right = -1e9;
  int head = 0, ankles = 0;
  for (size_t i = 0; i < kKeypointCount; ++i) {
    const auto name = static_cast<KeypointName>(i);
    const Keypoint& point = person[name];
    if (point.confidence < kSeenEnough) continue;
    if (name <= kRightEar) {
      top = std::min<double>(top, point.y_px);
      ++head;
    }
    if (name == kLeftAnkle || name == kRightAnkle) {
      bottom = std::max<double>(bottom, point.y_px);
      ++ankles;
    }
    left = std::min<double>(left, point.x_px);
    right = std::max<double>(right, point.x_px);
  }
  const double height = bottom - top;
  if (head == 0 || ankles == 0 || height <= 0) return std::nullopt;
  return cv::Rect(cv::Point2d(left - kBeside * height, top - kAboveHead * height),
                  cv::Point2d(right + kBeside * height, bottom + kBelowAnkle * height));
}

// First and last row in which enough of the figure is seen to be more than a speck.
std::optional<SeenFigure> ends_of(const cv::Mat& part, const cv::Rect& box, int shrink) {
  const int least = std::max(1, box.height / 80);
  int top = -1, bottom = -1;
  for (int y = 0; y < part.rows; ++y) {
    if (cv::countNonZero(part.row(y)) < least) continue;
    if (top < 0) top = y;
    bottom = y;
  }
  if (top < 0) return std::nullopt;
  const cv::Moments moments = cv::moments(part.rowRange(top, (top + bottom) / 2 + 1), true);
  // Edges lie between pixels.
  const auto enlarged = [&](double edge) { return shrink * edge - 0.5; };
  return SeenFigure{0,
                    0,
                    0,
                    enlarged(box.x + moments.m10 / moments.m00 + 0.5),
                    enlarged(box.y + top),
                    enlarged(box.y + bottom + 1)};
}

// The figure of a mask's box; nothing where it can be no whole person.
std::optional<SeenFigure> figure_of(const cv::Mat& part, const cv::Rect& box, const cv::Size& image,
                                    int shrink) {
  if (box.height < kLeastHeight * image.height || box.height > kMostHeight * image.height ||
      box.width > kWidest * box.height)
    return std::nullopt;
  if (box.x <= 1 || box.y <= 1 || box.x + box.width >= image.width - 1 ||
      box.y + box.height >= image.height - 1)
    return std::nullopt;  // cut off by the picture's edge
  return ends_of(part, box, shrink);
}

// Where the network sees a person: all that is foreground there, for a figure may be in pieces.
std::optional<SeenFigure> figure_in(const cv::Mat& mask, const cv::Rect& person, int shrink) {
  const cv::Rect around = cv::Rect(person.x / shrink, person.y / shrink, person.width / shrink,
                                   person.height / shrink) &
                          cv::Rect({}, mask.size());
  if (around.empty()) return std::nullopt;
  cv::Mat whole = cv::Mat::zeros(around.size(), CV_8U);
  for (const Part& part : parts_of(mask(around), kLeastPiece * around.height))
    whole(part.box).setTo(255, part.mask);
  const cv::Rect box = cv::boundingRect(whole);
  // A person's points span nine tenths of them; less foreground is not the person, or half hidden.
  if (box.height < kLeastCovered * around.height) return std::nullopt;
  return figure_of(whole(box), box + around.tl(), mask.size(), shrink);
}

// Who can be seen whole in one frame.
class FigureFinder {
 public:
  FigureFinder(const VideoFacts& facts, int shrink) : shrink_(shrink) {
    const auto file = has_pose_net() ? pose_model_file(std::string(kShippedModel)) : std::nullopt;
    if (!file) return;
    net_.emplace(read_text_file(*file, kMaxModelBytes), file->string());
    people_.emplace(facts.width_px, facts.height_px, 0.4 * facts.height_px);
  }

  std::vector<SeenFigure> in(const cv::Mat& frame, const cv::Mat& mask, int number) {
    std::vector<SeenFigure> found;
    const auto add = [&](const std::optional<SeenFigure>& figure) {
      if (figure) found.push_back(*figure);
    };
    if (net_) {
      for (const DetectedPerson& person : people_->look(*net_, frame, number))
        if (const auto box = box_of(person)) add(figure_in(mask, *box, shrink_));
    } else {
      for (const Part& part : parts_of(mask, kLeastHeight * mask.rows))
        add(figure_of(part.mask, part.box, mask.size(), shrink_));
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
  Foreground foreground(
      facts, background_of(job, {facts.width_px, facts.height_px}, shrink, threads, control),
      shrink, threads);
  FigureFinder finder(facts, shrink);
  const int every = std::max(1, static_cast<int>(std::lround(out.frame_rate / kLooks_hz)));
  out.looks_hz = out.frame_rate / every;
  cv::Mat frame;
  std::vector<FigureTrack> tracks;
  size_t looked = 0;
  for (int n = 0; looked < kMostFrames && !control.stopping() && source.read(frame); ++n) {
    control.progress("looking for the subject", static_cast<size_t>(n),
                     static_cast<size_t>(facts.frame_count));
    if (n % every != 0) continue;
    std::vector<SeenFigure> figures = finder.in(frame, foreground.of(frame), n / every);
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
    // Half overlapping.
    const double next = figures[from].time + 0.5 * kStride_s;
    while (from < figures.size() && figures[from].time < next) ++from;
  }
  return out;
}

}  // namespace jobs
}  // namespace walktrack
