// Which phase of the stride does a walker start in? Hypotheses over the whole stride are tracked
// side by side for a while, each a particle filter of its own, and compete by evidence, so that no
// single frame decides: a mixture whose components are resampled separately and whose weights are
// their evidence (Vermaak, Doucet & Perez, "Maintaining multi-modality through mixture tracking",
// ICCV 2003).
//
// A second round between the best and the best of those half a stride away (legs swapped) was
// tried: it lost blurred videos that the first round decides rightly, and won nothing for it.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tracker/start/start.h"
#include "tracker/walker_filter.h"

namespace walktrack {
inline namespace tracker {

class StartHypotheses {
 public:
  // Hypotheses around a detected; all over the stride, or at a stated phase of it (0 = left foot
  // strike). `filter`: as it will be used afterwards.
  StartHypotheses(const MotionContext& motion, const StartConfig& start, const FilterConfig& filter,
                  const DetectedWalk& detected, std::optional<double> stride_phase, uint64_t seed,
                  int threads);

  // The next frame; false when no hypothesis explains it.
  bool step(const WalkerFilterContext& context, const SceneEvidence& evidence, uint32_t frame);
  bool decided() const { return frames_ >= frames_to_decide_; }
  int frames() const { return frames_; }
  // The leading hypothesis' account of the frames so far.
  const std::vector<FrameRecord>& records() const { return leader().records; }
  // FilterConfig::particles of those that are left, in proportion to their evidence.
  std::vector<WalkerParticle> resampled() const;

 private:
  struct Hypothesis {
    WalkerFilter filter;
    uint64_t seed;
    double log_evidence = 0;
    std::vector<FrameRecord> records;
    bool rejected = false;  // has lost; followed on only to tell the doubt
  };

  const Hypothesis& leader() const;
  std::optional<uint64_t> mirror_hypothesis() const;
  void weigh_modes();

  FilterConfig filter_;
  uint64_t seed_;
  int frames_to_decide_;
  int frames_ = 0;
  std::vector<Hypothesis> hypotheses_;
};

}  // namespace tracker
}  // namespace walktrack
