// Which phase of the stride does a walker start in? Hypotheses over the whole stride are tracked
// side by side and compete by evidence. First all phases, then only the best and its rival: the
// best of those half a stride away, whose legs have changed places. In a side view, that is what
// images tell apart last; until they have, both are tracked.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "tracker/start.h"
#include "tracker/walker_filter.h"

namespace walktrack {

class Contest {
 public:
  // Hypotheses around a sighting; all over the stride, or at a stated phase of it (0 = left foot
  // strike). `filter`: as it will be used afterwards.
  Contest(const MotionContext& motion, const StartConfig& start, const FilterConfig& filter,
          const Sighting& sighting, std::optional<double> stride_phase, uint64_t seed, int threads);

  // The next frame; false when no hypothesis explains it.
  bool step(const WalkerFilterContext& context, const SceneEvidence& evidence, uint32_t frame);
  bool decided() const { return decided_; }
  int frames() const { return frames_; }
  // Mean log-likelihood per frame of the leading hypothesis' particles, nats.
  double support() const;
  // The leading hypothesis' account of the frames so far.
  const std::vector<FrameRecord>& records() const { return leader().records; }
  // FilterConfig::particles of those that are left, in proportion to their evidence.
  std::vector<WalkerParticle> survivors() const;

 private:
  struct Hypothesis {
    WalkerFilter filter;
    uint64_t seed;
    int phase;  // its range's number, around the stride
    double log_evidence = 0;
    std::vector<FrameRecord> records;
  };

  const Hypothesis& leader() const;
  bool rivals(int phase, int other) const;
  std::vector<WalkerParticle> drawn(const std::vector<const Hypothesis*>& from) const;
  void drop_hopeless();
  void keep_two();

  StartConfig start_;
  FilterConfig filter_;
  uint64_t seed_;
  int threads_;
  int phases_ = 0;                  // around the stride
  int first_round_, second_round_;  // frames
  int frames_ = 0;
  bool decided_ = false;
  std::vector<Hypothesis> hypotheses_;
};

}  // namespace walktrack
