#include "jobs/track/report/track_quality.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <map>

#include <fmt/format.h>

#include "jobs/track/report/quality_words.h"
#include "metrics/gait.h"
#include "metrics/leg_swaps.h"
#include "metrics/plausibility.h"
#include "tracker/overlaps.h"

namespace walktrack {
inline namespace jobs {

namespace {

QualityMeasure at_most(std::string_view name, double value, double limit) {
  QualityMeasure m = quality_measure(name, value);
  m.limit = limit;
  return m;
}

QualityMeasure at_least(std::string_view name, double value, double limit) {
  QualityMeasure m = at_most(name, value, limit);
  m.at_most = false;
  return m;
}

double percent(double part, double whole) { return whole > 0 ? 100 * part / whole : 0; }

// Counts over the frames of a track.
struct QualityCounts {
  int tracked = 0, lost = 0, moving = 0;  // frames; lost: after the first tracked one
  double p_legs_swapped = 0;              // sum of probabilities
  double better_beside = 0;               // sum, nats
};

QualityCounts quality_counts(const TrackedFrames& frames) {
  QualityCounts out;
  for (const FrameRecord& record : frames.records) {
    if (record.tracked) {
      ++out.tracked;
      out.p_legs_swapped += record.modes.p_legs_swapped;
      out.better_beside += record.fit.better_beside;
      continue;
    }
    if (out.tracked > 0) ++out.lost;
    if (record.moving > kSomebodyMoves) ++out.moving;
  }
  return out;
}

// Without silhouettes nothing is measured.
void add_overlap(const TrackedFrames& frames, const QualityConfig& limits, Quality& out) {
  std::vector<double> overlaps = mean_overlaps(fits_of(frames.records));
  std::erase_if(overlaps, [](double overlap) { return std::isnan(overlap); });
  if (overlaps.empty()) return;
  out.push_back(
      at_least("overlap_percent", 100 * *std::ranges::min_element(overlaps), 100 * limits.overlap));
}

// The quality before feet were planted, which hides some errors.
Quality quality_before(const TrackedFrames& moving, const QualityConfig& limits) {
  const Motion motion = motion_of(moving);
  const Plausibility p = plausibility(motion, gait_from_motion(motion));
  return {
      at_most("tracked_slide_along_walk_mm", 1000 * p.mean_slide_along, 1000 * limits.foot_slide),
      at_most("tracked_penetration_mm", 1000 * p.penetration, 1000 * limits.penetration)};
}

}  // namespace

int frames_out_of_picture(const TrackedFrames& frames) {
  int out = 0;
  bool left = false;
  for (const FrameRecord& record : frames.records) {
    left = !record.tracked && (left || record.out_of_picture);
    if (left && record.moving <= kSomebodyMoves) ++out;
  }
  return out;
}

Quality quality_of_motion(const Motion& motion, double rate, double leg) {
  const Plausibility p = plausibility(motion, gait_from_motion(motion));
  const double minutes = static_cast<double>(motion.time.size()) / rate / 60;
  const auto swaps = static_cast<double>(leg_swaps(motion));
  return {quality_measure("leg_swaps_per_min", minutes > 0 ? swaps / minutes : 0),
          quality_measure("steps_off_way_percent", 100 * p.steps_off_way),
          quality_measure("missing_steps", p.missing_steps),
          quality_measure("longest_step_leg_lengths", p.longest_step / leg),
          quality_measure("shortest_step_m", p.shortest_step),
          quality_measure("quickest_step_percent", 100 * p.quickest_step),
          quality_measure("fastest_m_s", p.fastest),
          quality_measure("foot_slide_mm", 1000 * p.mean_foot_slide),
          quality_measure("worst_foot_slide_mm", 1000 * p.worst_foot_slide),
          quality_measure("penetration_mm", 1000 * p.penetration),
          quality_measure("jitter_m_s3", p.jitter)};
}

Quality quality_of(const TrackedFrames& frames, const TrackedFrames& moving,
                   const QualityConfig& limits, double leg) {
  const QualityCounts counts = quality_counts(frames);
  const int lost = counts.lost - frames_out_of_picture(frames);
  Quality out{
      at_most("lost_percent", percent(lost, counts.tracked + lost), 100 * limits.lost_share),
      at_most("untracked_movement_percent", percent(counts.moving, counts.tracked + counts.moving),
              100 * limits.untracked_movement),
      at_least("frame_rate_hz", frames.frame_rate, limits.frame_rate),
      at_least("foot_changes", foot_changes(frames), limits.least_steps)};
  add_overlap(frames, limits, out);
  out.push_back(at_most("better_beside_nats", counts.better_beside / std::max(1, counts.tracked),
                        limits.better_beside_nats));
  out.push_back(at_most("legs_exchanged_percent", percent(counts.p_legs_swapped, counts.tracked),
                        100 * limits.legs_swapped));
  const std::map<std::string, double> most{{"leg_swaps_per_min", limits.leg_swaps},
                                           {"steps_off_way_percent", 100 * limits.steps_off_way},
                                           {"missing_steps", limits.missing_steps},
                                           {"longest_step_leg_lengths", limits.longest_step},
                                           {"fastest_m_s", limits.fastest},
                                           {"jitter_m_s3", limits.jitter}};
  for (QualityMeasure& m : quality_of_motion(motion_of(frames), frames.frame_rate, leg)) {
    if (const auto limit = most.find(m.name); limit != most.end()) m.limit = limit->second;
    if (m.name == "shortest_step_m") m = at_least(m.name, m.value, limits.shortest_step);
    if (m.name == "quickest_step_percent")
      m = at_least(m.name, m.value, 100 * limits.quickest_step);
    out.push_back(std::move(m));
  }
  for (QualityMeasure& m : quality_before(moving, limits)) out.push_back(std::move(m));
  return out;
}

std::optional<QualityMeasure> quality_of_keypoints(const KeypointUse& use,
                                                   const QualityConfig& limits) {
  constexpr int64_t kFewest = 5;
  if (use.frames < kFewest) return std::nullopt;
  return at_least("on_detected_percent", percent(double(use.matched), double(use.frames)),
                  100 * limits.on_detected);
}

Quality failures(const Quality& quality) {
  Quality out;
  std::copy_if(quality.begin(), quality.end(), std::back_inserter(out),
               [](const QualityMeasure& each) { return !each.passed(); });
  return out;
}

std::string failure_text(const QualityMeasure& m) {
  return fmt::format("{}: {:.{}f}{}{} (allowed: {} {:g})", m.what, m.value, m.digits,
                     m.unit.empty() ? "" : " ", m.unit, m.at_most ? "at most" : "at least",
                     *m.limit);
}

std::string first_failure(const Quality& quality) {
  const Quality failed = failures(quality);
  return failed.empty() ? std::string() : failure_text(failed.front());
}

}  // namespace jobs
}  // namespace walktrack
