// The frame of the batch kernels: queues of walkers, their visits to a vector and the end of a
// visit; internal to lib/walker.
//
// Between visits to a vector a walker's state is in its own struct; during a visit it is a lane.
// A kernel derives from this class with its lanes and the spans of a call, and defines
//   load(i, lane, lanes), store(lanes, lane)   a walker into a lane and back
//   evaluate(lanes)                            the accelerations of all lanes
//   begin(lanes)                               sub-steps, for the first visit of walkers in a call
//   sub_step(lanes)                            one sub-step of every live lane
//   has_fallen(lanes, lane)
//   resolve(lanes)                             the events of lanes that met one
#pragma once

#include "walker/kneed/kneed_advance.h"
#include "walker/lanes/lanes.h"

namespace walktrack {
inline namespace walker {

template <typename Kernel, typename Input, typename Lanes>
class LaneBatch {
 public:
  explicit LaneBatch(const Input& input)
      : in(input),
        progress(input.states.size(), scratch.memory()),
        queues(input.states.size(), scratch.memory()) {
    for (size_t i = progress.size(); i-- > 0;) {
      in.results[i] = {};
      if (0 < in.durations[i]) queues.ready.push_back(i);
    }
  }

  void run() {
    Lanes lanes;
    const auto go_on = [&] {
      take(queues.ready, lanes);
      walk(lanes);
    };
    const auto meet = [&] {
      take(queues.met, lanes);
      kernel().resolve(lanes);
    };
    queues.serve(lane_limit, go_on, meet);
  }

 protected:
  void finish(Lanes& lanes, size_t lane, KneedEvent event) {
    put_back(lanes, lane);
    in.results[lanes.index[lane]] = {.elapsed = lanes.elapsed[0][lane], .event = event};
  }

  // The time of a lane after a sub-step: exactly the duration after the last one.
  static void pass(Lanes& lanes, size_t lane, double step) {
    const double left = lanes.duration[0][lane] - lanes.elapsed[0][lane];
    lanes.since[0][lane] += step;
    lanes.elapsed[0][lane] = step == left ? lanes.duration[0][lane] : lanes.elapsed[0][lane] + step;
  }

  const Input& in;
  const size_t lane_limit = lane_count();
  BatchScratch scratch;
  std::pmr::vector<LaneProgress> progress;
  LaneQueues queues;

 private:
  Kernel& kernel() { return static_cast<Kernel&>(*this); }

  // Moves the last walkers of a queue into lanes and evaluates them.
  void take(std::pmr::vector<size_t>& queue, Lanes& lanes) {
    LaneQueues::seat(queue, lane_limit, lanes);
    for (size_t lane = 0; lane < lane_limit; ++lane) {
      const size_t i = lanes.index[lane];
      lanes.duration[0][lane] = in.durations[i];
      lanes.elapsed[0][lane] = progress[i].elapsed;
      lanes.step[0][lane] = progress[i].step;
      kernel().load(i, lane, lanes);
    }
    kernel().evaluate(lanes);
  }

  void put_back(Lanes& lanes, size_t lane) {
    kernel().store(lanes, lane);
    progress[lanes.index[lane]].elapsed = lanes.elapsed[0][lane];
    lanes.live[0][lane] = 0;
  }

  void walk(Lanes& lanes) {
    bool fresh = false, any = false;
    for (size_t lane = 0; lane < lanes.count; ++lane)
      fresh = fresh || progress[lanes.index[lane]].step == 0;
    if (fresh) kernel().begin(lanes);
    for (size_t lane = 0; lane < lanes.count; ++lane) any = any || lanes.live[0][lane] != 0;
    while (any) {
      const LaneVerdict verdict = kernel().sub_step(lanes);
      if ((verdict.diverged | verdict.event | verdict.ended) == 0) continue;
      any = false;
      for (size_t lane = 0; lane < lanes.count; ++lane) {
        leave(lanes, lane, verdict);
        any = any || lanes.live[0][lane] != 0;
      }
    }
  }

  void leave(Lanes& lanes, size_t lane, const LaneVerdict& verdict) {
    const uint64_t bit = uint64_t{1} << lane;
    if ((verdict.diverged & bit) != 0) {
      finish(lanes, lane, KneedEvent::kDiverged);
    } else if ((verdict.event & bit) != 0) {
      put_back(lanes, lane);
      queues.met.push_back(lanes.index[lane]);
    } else if ((verdict.ended & bit) != 0) {
      const bool fallen = kernel().has_fallen(lanes, lane);
      finish(lanes, lane, fallen ? KneedEvent::kFallen : KneedEvent::kNone);
    }
  }
};

}  // namespace walker
}  // namespace walktrack
