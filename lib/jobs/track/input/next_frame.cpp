#include "jobs/track/input/next_frame.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "core/parallel_for.h"
#include "observation/image.h"

namespace walktrack {
inline namespace jobs {

namespace {

// Whether any occluder is present for a limited time only.
bool comes_or_goes(const SceneCamera& camera) {
  return std::any_of(camera.occluders.begin(), camera.occluders.end(), [](const Occluder& each) {
    return std::isfinite(each.from) || std::isfinite(each.to);
  });
}

}  // namespace

NextFrame::NextFrame(const Scene& scene, SceneVideo& video, std::vector<Observer>& observers,
                     Detections& detections)
    : scene_(scene),
      video_(video),
      observers_(observers),
      detections_(detections),
      pictures_(observers.size()),
      prepared_(observers.size()),
      cpu_seconds_(observers.size()) {}

NextFrame::Cost NextFrame::fetch(std::span<const Region> regions, bool around, int threads,
                                 int row_threads) {
  Cost cost;
  const Clock::time_point start = Clock::now();
  const double cpu = thread_cpu_seconds();
  there_ = video_.read(frames_);
  fetched_ = true;
  cost.decode = {seconds_since(start), thread_cpu_seconds() - cpu};
  if (!there_) return cost;
  const Clock::time_point decoded = Clock::now();
  prepare(regions, around, threads, row_threads);
  cost.prepare = {seconds_since(decoded),
                  std::accumulate(cpu_seconds_.begin(), cpu_seconds_.end(), 0.0)};
  return cost;
}

void NextFrame::prepare(std::span<const Region> regions, bool around, int threads,
                        int row_threads) {
  parallel_for(observers_.size(), threads, [&](size_t c) {
    const double start = thread_cpu_seconds();
    if (frames_.fresh[c]) {
      const FrameSource& source = video_.source(c);
      const FrameToLookAt frame{source, frames_.source[c], frames_.number, regions[c], around};
      if (!scene_.cameras[c].video.empty()) source.picture(observers_[c].shrink(), pictures_[c]);
      observers_[c].prepare(pictures_[c], regions[c], row_threads, prepared_[c],
                            detections_.look(c, frame));
    }
    cpu_seconds_[c] = thread_cpu_seconds() - start;
  });
}

void NextFrame::complete(double time, int threads, SceneEvidence& out) {
  parallel_for(observers_.size(), threads, [&](size_t c) {
    const SceneCamera& camera = scene_.cameras[c];
    if (comes_or_goes(camera)) observers_[c].hide(occluders_at(camera, time));
    if (frames_.fresh[c]) {
      observers_[c].complete(prepared_[c], out[c]);
    } else {
      out[c] = CameraEvidence{};  // a repeated frame contains no new evidence
      observers_[c].forget_previous_frame();
    }
  });
  fetched_ = false;
}

void NextFrame::close() {
  video_.close();
  for (Image& picture : pictures_) picture = Image();
  for (PreparedFrame& frame : prepared_) frame = PreparedFrame();
  there_ = false;
}

}  // namespace jobs
}  // namespace walktrack
