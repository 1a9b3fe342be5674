// The two threading primitives, for both of which results do not depend on the number of threads.
// Exceptions are passed on to the caller.
//
// parallel_for: f(i) for every i in [0, n), each index exactly once. A call must write only what
// belongs to its index; sums are taken in index order afterwards.
//
// run_beside: calls here() and beside() in parallel; neither may read what the other one writes.
// Threads that have finished one help with the parallel_for of the other.
#pragma once

#include <cstddef>
#include <functional>
#include <memory>
#include <type_traits>

namespace walktrack {
inline namespace core {

// Number of threads of this machine that the process may use (core/cpu_limits.h), at least 1.
int hardware_threads();

// The wanted number; 0: all that the process may use.
int thread_count(int wanted);

// Calls body(context, begin, end) on disjoint ranges that cover [0, n).
void parallel_ranges(size_t n, int threads, void (*body)(void*, size_t, size_t), void* context);

template <typename F>
void parallel_for(size_t n, int threads, F&& f) {
  using Callable = std::remove_reference_t<F>;
  auto body = [](void* context, size_t begin, size_t end) {
    Callable& call = *static_cast<Callable*>(context);
    for (size_t i = begin; i < end; ++i) call(i);
  };
  parallel_ranges(n, threads, body, const_cast<void*>(static_cast<const void*>(std::addressof(f))));
}

void run_beside(int threads, const std::function<void()>& here,
                const std::function<void()>& beside);

}  // namespace core
}  // namespace walktrack
