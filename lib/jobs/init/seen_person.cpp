#include "jobs/init/seen_person.h"

#include <algorithm>
#include <cmath>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/video/video.h"
#include "jobs/init/figure_tracks.h"
#include "jobs/track/input/person_finder.h"
#include "jobs/track/input/pose_model.h"
#include "observation/image.h"

namespace walktrack {
inline namespace jobs {

namespace {

constexpr double kPersonLooks_hz = 15;     // rate of the frames that are searched: several in each
                                           // step
constexpr size_t kMostPersonFrames = 900;  // with somebody in them
constexpr double kPersonShare = 0.4;       // of the image's height: the assumed size of a person at
                                           // first
constexpr double kLeastSize_px = 40;
constexpr double kLeastMeanConfidence = 0.3;  // of the points, mean

PoseNet shipped_net() {
  const auto file = has_pose_net() ? pose_model_file(std::string(kShippedModel)) : std::nullopt;
  if (!file)
    throw UsageError(
        "two videos need the pose network, which this program was built without; allowed: one "
        "video, or cameras from 'walktrack calibrate'");
  return {read_text_file(*file, kMaxModelBytes), file->string()};
}

// The bounding box of the points.
std::optional<SeenFigure> points_box(const DetectedPerson& person, size_t number) {
  constexpr size_t kPoints = 17;  // the points of COCO
  SeenFigure out{0, 0, number, 0, person.points[0].y_px, person.points[0].y_px};
  double confidence = 0;
  for (size_t i = 0; i < kPoints; ++i) {
    const Keypoint& point = person.points[i];
    confidence += point.confidence / kPoints;
    out.u_px += point.x_px / kPoints;
    out.top_px = std::min<double>(out.top_px, point.y_px);
    out.bottom_px = std::max<double>(out.bottom_px, point.y_px);
  }
  const bool whole = size_of(out) >= kLeastSize_px && confidence >= kLeastMeanConfidence;
  return whole ? std::optional(out) : std::nullopt;
}

}  // namespace

SeenPerson seen_person(const std::filesystem::path& video, const std::optional<double>& frame_rate,
                       const JobControl& control) {
  PoseNet net = shipped_net();
  FrameSource source(video);
  const VideoFacts facts = source.facts();
  SeenPerson out;
  out.width_px = facts.width_px;
  out.height_px = facts.height_px;
  out.frame_rate = frame_rate.value_or(facts.frame_rate);
  if (out.frame_rate <= 0)
    throw InputError(
        describe({video.string(), 0, ""}, "no frame rate", "images with --frame-rate HZ"));
  const int every = std::max(1, static_cast<int>(std::lround(out.frame_rate / kPersonLooks_hz)));
  PersonFinder finder(facts.width_px, facts.height_px, kPersonShare * facts.height_px);
  std::vector<FigureTrack> tracks;
  std::vector<DetectedPeople> seen;  // by searched frame
  Image frame;
  for (int n = 0; seen.size() < kMostPersonFrames && !control.stopping() && source.advance(); ++n) {
    control.progress("looking for the subject in " + video.filename().string(),
                     static_cast<size_t>(n), static_cast<size_t>(facts.frame_count));
    if (n % every != 0) continue;
    source.picture(frame);
    seen.push_back(finder.look(net, frame, n / every));
    for (size_t i = 0; i < seen.back().size(); ++i)
      if (auto figure = points_box(seen.back()[i], i)) {
        figure->frame = n;
        figure->time = n / out.frame_rate;
        link(*figure, tracks);
      }
  }
  const FigureTrack walker = walker_of(tracks, way_anywhere);
  for (const SeenFigure& figure : walker) {
    out.moments.push_back(
        {figure.time, seen[static_cast<size_t>(figure.frame / every)][figure.person]});
    out.frames.push_back(figure.frame);
  }
  if (out.moments.empty())
    throw InputError(describe({video.string(), 0, ""}, "no person that the pose network detects",
                              "a video of somebody who walks"));
  return out;
}

}  // namespace jobs
}  // namespace walktrack
