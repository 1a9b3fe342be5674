// What all batch kernels share: walkers as lanes of vectors, in structures of arrays, and the
// queues they wait in; internal to lib/walker. lanes-inl.h is the part in vector instructions.
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <memory_resource>
#include <vector>

#include "core/scratch.h"

namespace walktrack {
inline namespace walker {

// Walkers in a vector at most: doubles in the widest vectors there are.
inline constexpr size_t kMaxLanes = 8;

template <size_t kCount>
struct alignas(64) LaneRows {
  double rows[kCount][kMaxLanes];
  double* operator[](size_t i) { return rows[i]; }
  const double* operator[](size_t i) const { return rows[i]; }
};

// Who is in a vector, and how far in time.
struct LaneGroup {
  size_t count = 0;                            // walkers; lanes beyond repeat the first
  size_t index[kMaxLanes]{};                   // into the batch
  LaneRows<1> live;                            // 1 for a lane that goes on
  LaneRows<1> step, elapsed, duration, since;  // s
};

// What a sub-step has led to, one bit a lane.
struct LaneVerdict {
  uint64_t diverged, event, ended;
};

// How far a walker has come in a call.
struct LaneProgress {
  double elapsed = 0, step = 0;  // s; step 0 before the first visit
  int stop_events = 0;           // of a walker with knees
};

// Lanes of the instruction set in use, <= kMaxLanes, and its name.
size_t lane_count();
const char* lane_target();

// What a call keeps of its walkers fits on the stack for as many as the tracker moves together.
using BatchScratch = Scratch<4096>;

// Walkers wait in two queues: those that can go on, and those that know of an event within their
// next sub-step. Both are served a vector at a time, full vectors first.
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

  // The last walkers of a queue leave it and take their seats.
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
