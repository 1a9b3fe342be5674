// Common parts of all batch kernels: walkers as lanes of vectors, in structures of arrays, and
// their queues; internal to lib/walker. lanes-inl.h contains the vector code.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "core/scratch.h"

namespace walktrack {
inline namespace walker {

// Largest number of walkers in a vector: doubles in the widest vectors.
inline constexpr size_t kMaxLanes = 8;

template <size_t kCount>
struct alignas(64) LaneRows {
  double rows[kCount][kMaxLanes];
  double* operator[](size_t i) { return rows[i]; }
  const double* operator[](size_t i) const { return rows[i]; }
};

// The walkers in a vector, with their times.
struct LaneGroup {
  size_t count = 0;                            // walkers; lanes after them repeat the first
  size_t index[kMaxLanes]{};                   // into the batch
  LaneRows<1> live;                            // 1 for a lane that continues
  LaneRows<1> step, elapsed, duration, since;  // s
};

// The outcome of a sub-step, one bit for each lane.
struct LaneVerdict {
  uint64_t diverged, event, ended;
};

// The progress of a walker in a call.
struct LaneProgress {
  double elapsed = 0, step = 0;  // s; step 0 before the first visit
  int stop_events = 0;           // of a walker with knees
};

// Lanes of the instruction set in use, <= kMaxLanes, and its name.
size_t lane_count();
const char* lane_target();

// The data of a call fit on the stack for as many walkers as the tracker advances together.
using BatchScratch = Scratch<4096>;

// Walkers wait in two queues: those that can continue, and those with an event within their next
// sub-step. Both are processed a vector at a time, full vectors first.
struct LaneQueues {
  std::pmr::vector<size_t> ready, met;

  LaneQueues(size_t walkers, std::pmr::memory_resource* memory) : ready(memory), met(memory) {
    ready.reserve(walkers);
    met.reserve(walkers);
  }

  template <typename Walk, typename Resolve>
  void serve(size_t lanes, const Walk& walk, const Resolve& resolve) {
    while (!ready.empty() || !met.empty()) {
      const bool scarce = ready.size() < lanes;
      if (met.size() >= lanes || (scarce && !met.empty())) {
        resolve();
      } else {
        walk();
      }
    }
  }

  // Removes the last walkers of a queue and assigns them to lanes.
  static void seat(std::pmr::vector<size_t>& queue, size_t lanes, LaneGroup& group) {
    group.count = std::min(lanes, queue.size());
    for (size_t lane = 0; lane < lanes; ++lane) {
      const bool live = lane < group.count;
      group.index[lane] = live ? queue[queue.size() - 1 - lane] : group.index[0];
      group.live[0][lane] = live ? 1 : 0;
    }
    queue.resize(queue.size() - group.count);
  }
};

}  // namespace walker
}  // namespace walktrack
