// The anthropomorphic walker's benchmarks, legs.cpp, and the counters of all benchmarks.
#pragma once

#include <benchmark/benchmark.h>

namespace walktrack {

// `s_each`: seconds for one of the items of an iteration.
inline void set_items(benchmark::State& state, double items) {
  using benchmark::Counter;
  state.counters["s_each"] = Counter(items, Counter::kIsIterationInvariantRate | Counter::kInvert);
}

// Throws unless the limit of the anthropomorphic walker computes the same as the walker.
void check_legs();

}  // namespace walktrack
