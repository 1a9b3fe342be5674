#include "jobs/track/results/overlay_video.h"

#include <algorithm>
#include <utility>

#include <fmt/format.h>

#include "core/parallel_for.h"
#include "io/drawing/overlay.h"
#include "io/drawing/overlay_view.h"
#include "io/video/scene_video.h"
#include "io/video/video_writer.h"
#include "jobs/track/results/keypoint_results.h"
#include "jobs/track/track_setup.h"

namespace walktrack {
inline namespace jobs {

namespace {

constexpr double kSpreadOpacity = 0.35;  // of the particles' figures; by hand

// One camera's video on its way.
struct CameraVideo {
  const Camera& camera;
  int shrink;                      // of the images that detections are of
  std::vector<OverlayView> views;  // one, or one for each frame
  VideoWriter writer;
  // Pictures of the view: of one frame after the other, encoded, drawn into and read at the same
  // time.
  Image before, now, next;

  const OverlayView& view(size_t frame) const { return views[std::min(frame, views.size() - 1)]; }
};

std::vector<OverlayView> views_of(const Camera& camera, const Motion& motion,
                                  const OverlayConfig& config) {
  std::vector<OverlayView> out{whole_view(camera, config.width)};
  if (config.crop && !motion.joints.empty())
    out = views_around(camera, motion.joints, config.width);
  return out;
}

std::vector<CameraVideo> opened(const TrackJob& job, const TrackedFrames& frames,
                                const std::vector<ReportClip>& clips) {
  const OverlayConfig& config = job.config.values.overlay;
  const Motion motion = config.crop ? motion_of(frames) : Motion{};
  std::vector<CameraVideo> out;
  for (size_t c = 0; c < clips.size(); ++c) {
    const Camera& camera = job.scene.cameras[c].camera;
    std::vector<OverlayView> views = views_of(camera, motion, config);
    VideoWriter writer(clips[c].file, views.front().size, frames.frame_rate, config.preset);
    const int shrink = working_scale(job.scene, camera, job.config.values).shrink;
    out.push_back({camera, shrink, std::move(views), std::move(writer), {}, {}, {}});
  }
  return out;
}

// What a frame's record says, into the video's picture of it. `fresh`: whether detections are of
// this very picture.
void draw_record(const FrameRecord& record, size_t camera, const OverlayView& view, bool arms,
                 double time, bool fresh, CameraVideo& video) {
  Image& image = video.now;
  const Camera seen = camera_of(view, video.camera);
  if (fresh && !record.keypoints.empty())
    draw_keypoints(record.keypoints[camera], video.shrink, view, image);
  if (!record.tracked) return draw_caption(image, fmt::format("{:.2f} s  not tracked", time));
  draw_spread(image, seen, record.samples, arms, kSpreadOpacity);
  draw_skeleton(image, seen, record.estimate.joints, arms, 2 * line_thickness(image));
  draw_caption(image, fmt::format("{:.2f} s  {:.2f} m/s", time, record.estimate.speed));
}

// Frames as they are read and shrunk, one ahead of those that are drawn.
class OverlayPictures {
 public:
  OverlayPictures(const Scene& scene, std::vector<CameraVideo>& videos)
      : video_(scene), videos_(videos) {}

  // The frame `i` into all `next`; false if there is none.
  bool read(size_t i) {
    if (!video_.read(frames_)) return false;
    for (size_t c = 0; c < videos_.size(); ++c)
      look_through(videos_[c].view(i), video_.source(c), videos_[c].next);
    return true;
  }
  // Makes what was drawn last what is encoded, and what was read last what is drawn into.
  void turn() {
    for (CameraVideo& each : videos_) {
      std::swap(each.before, each.now);
      std::swap(each.now, each.next);
    }
    fresh_ = frames_.fresh;
  }
  bool fresh(size_t camera) const { return fresh_[camera]; }

 private:
  SceneVideo video_;
  std::vector<CameraVideo>& videos_;
  SceneFrames frames_;
  std::vector<char> fresh_;  // of what is drawn into
};

}  // namespace

std::string overlay_name(const SceneCamera& camera) {
  return fmt::format("overlay_{}.mp4", camera.name);
}

std::vector<ReportClip> write_overlays(const TrackJob& job, const TrackedFrames& frames,
                                       const ResultFolder& folder, int threads,
                                       const JobControl& control) {
  std::vector<ReportClip> clips;
  for (const SceneCamera& camera : job.scene.cameras)
    clips.push_back({camera.name, folder.file(overlay_name(camera))});
  std::vector<CameraVideo> videos = opened(job, frames, clips);
  OverlayPictures pictures(job.scene, videos);
  const bool arms = job.config.values.body.arms;
  const size_t count = frames.records.size();
  bool drawn = false, there = count > 0 && pictures.read(0);
  for (size_t i = 0; there || drawn; ++i) {
    const bool encode = drawn, draw = there;  // frame i - 1, frame i
    pictures.turn();
    const FrameRecord record = draw ? frames.records[i] : FrameRecord{};
    const double time = static_cast<double>(i) / frames.frame_rate;
    const auto work = [&](size_t task) {
      const size_t c = task / 2;
      if (task % 2 == 0 && draw)
        draw_record(record, c, videos[c].view(i), arms, time, pictures.fresh(c), videos[c]);
      if (task % 2 == 1 && encode) videos[c].writer.write(videos[c].before);
    };
    run_beside(
        threads, [&] { parallel_for(2 * videos.size(), threads, work); },
        [&] { there = i + 1 < count && pictures.read(i + 1); });
    drawn = draw;
    if (draw) control.progress("drawing", i + 1, count);
  }
  for (CameraVideo& each : videos) each.writer.close();
  choose_embedded(clips, static_cast<uintmax_t>(1e6 * job.config.values.report.embed_mb));
  return clips;
}

}  // namespace jobs
}  // namespace walktrack
