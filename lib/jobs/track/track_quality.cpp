#include "jobs/track/track_quality.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

#include "metrics/gait.h"
#include "metrics/leg_swaps.h"
#include "metrics/plausibility.h"

namespace walktrack {

namespace {

QualityMeasure measure(std::string name, std::string what, double value, std::string unit,
                       int digits) {
  return {std::move(name), std::move(what), value, std::move(unit), digits, std::nullopt, true};
}

QualityMeasure at_most(QualityMeasure m, double gate) {
  m.gate = gate;
  return m;
}

QualityMeasure at_least(QualityMeasure m, double gate) {
  m.gate = gate;
  m.at_most = false;
  return m;
}

// Per cent of the frames from the first tracked one on.
double lost_percent(const TrackedFrames& frames) {
  int tracked = 0, lost = 0;
  for (const FrameRecord& record : frames.records) {
    if (record.tracked) ++tracked;
    if (!record.tracked && tracked > 0) ++lost;
  }
  return tracked > 0 ? 100.0 * lost / (tracked + lost) : 0;
}

// Mean over the tracked frames, per cent.
double exchanged_percent(const TrackedFrames& frames) {
  int tracked = 0;
  double sum = 0;
  for (const FrameRecord& record : frames.records) {
    if (!record.tracked) continue;
    ++tracked;
    sum += record.modes.exchanged;
  }
  return tracked > 0 ? 100 * sum / tracked : 0;
}

// What planting feet takes away, of the frames before it.
Quality quality_before(const TrackedFrames& moving, const GateConfig& gates) {
  const Motion motion = motion_of(moving);
  const Plausibility p = plausibility(motion, gait_from_motion(motion));
  return {
      at_most(measure("tracked_foot_slide_mm", "Sliding of a standing foot before feet are planted",
                      1000 * p.mean_foot_slide, "mm", 0),
              1000 * gates.foot_slide),
      at_most(
          measure("tracked_penetration_mm", "Deepest foot in the ground before feet are planted",
                  1000 * p.penetration, "mm", 0),
          1000 * gates.penetration)};
}

}  // namespace

Quality quality_of_motion(const Motion& motion, double rate) {
  const Plausibility p = plausibility(motion, gait_from_motion(motion));
  const double minutes = static_cast<double>(motion.time.size()) / rate / 60;
  const auto swaps = static_cast<double>(leg_swaps(motion));
  return {
      measure("leg_swaps_per_min", "Legs swapped between frames", minutes > 0 ? swaps / minutes : 0,
              "/min", 1),
      measure("foot_slide_mm", "Sliding of a standing foot, mean of stances",
              1000 * p.mean_foot_slide, "mm", 0),
      measure("worst_foot_slide_mm", "Sliding of a standing foot, worst stance",
              1000 * p.worst_foot_slide, "mm", 0),
      measure("penetration_mm", "Deepest foot in the ground", 1000 * p.penetration, "mm", 0),
      measure("jitter_m_s3", "Jitter: mean third derivative of the joints", p.jitter, "m/s³", 0),
  };
}

Quality quality_of(const TrackedFrames& frames, const TrackedFrames& moving,
                   const GateConfig& gates) {
  Quality out{
      at_most(
          measure("lost_percent", "Lost after the walker was found", lost_percent(frames), "%", 1),
          100 * gates.lost_share),
      at_least(measure("foot_changes", "Changes of the standing foot", foot_changes(frames), "", 0),
               gates.least_steps),
      measure("legs_exchanged_percent", "Left and right may be exchanged, mean probability",
              exchanged_percent(frames), "%", 0)};
  const std::map<std::string, double> limits{{"leg_swaps_per_min", gates.leg_swaps},
                                             {"jitter_m_s3", gates.jitter}};
  for (QualityMeasure& m : quality_of_motion(motion_of(frames), frames.frame_rate)) {
    const auto limit = limits.find(m.name);
    out.push_back(limit == limits.end() ? std::move(m) : at_most(std::move(m), limit->second));
  }
  for (QualityMeasure& m : quality_before(moving, gates)) out.push_back(std::move(m));
  return out;
}

std::string first_failure(const Quality& quality) {
  for (const QualityMeasure& m : quality) {
    if (m.passed()) continue;
    return fmt::format("{}: {:.{}f}{}{} (gate {} {:g})", m.what, m.value, m.digits,
                       m.unit.empty() ? "" : " ", m.unit, m.at_most ? "at most" : "at least",
                       *m.gate);
  }
  return {};
}

}  // namespace walktrack
