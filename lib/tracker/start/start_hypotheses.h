// Finds the phase of the stride in which a walker starts. Hypotheses over the whole stride are
// tracked side by side for a while, each by a particle filter of its own, and compete by their
// evidence, so that no single frame decides: a mixture whose components are resampled separately
// and whose weights are their evidence (Vermaak, Doucet & Perez, "Maintaining multi-modality
// through mixture tracking", ICCV 2003).
//
// A second round between the best hypothesis and the best of those half a stride away (legs
// swapped) was tried: it lost blurred videos that the first round decides correctly, and improved
// nothing.
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
  // A hypothesis around a detected walk for each range of phases; one that stands has none.
  // `filter`: the configuration that will be used afterwards.
  StartHypotheses(const MotionContext& motion, const StartConfig& start, const FilterConfig& filter,
                  const DetectedWalk& detected, const std::vector<PhaseRange>& ranges,
                  uint64_t seed, int threads);

  // Adds the next frame; false if no hypothesis explains it.
  bool step(const WalkerFilterContext& context, const SceneEvidence& evidence, uint32_t frame);
  bool decided() const { return frames_ >= frames_to_decide_; }
  int frames() const { return frames_; }
  // The records of the frames so far, by the best hypothesis.
  const std::vector<FrameRecord>& records() const { return leader().records; }
  // FilterConfig::particles particles of the hypotheses that are left, in proportion to their
  // evidence.
  std::vector<WalkerParticle> resampled() const;

 private:
  struct Hypothesis {
    WalkerFilter filter;
    uint64_t seed;
    double log_evidence = 0;
    std::vector<FrameRecord> records;
    bool rejected = false;  // has lost; still tracked, only to know how probable it is
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
