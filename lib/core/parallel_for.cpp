#include "core/parallel_for.h"

#include <algorithm>
#include <exception>
#include <thread>

#include <tbb/blocked_range.h>
#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <tbb/task_group.h>

#include "core/cpu_limits.h"

#ifdef __SANITIZE_THREAD__
#include <sanitizer/tsan_interface.h>
#endif

namespace walktrack {
inline namespace core {

namespace {

// TBB's library is not built for the thread sanitizer, which therefore does not see its
// synchronisation. With annotations of the two cases on which parallel_ranges() relies, it still
// finds races between ranges.
#ifdef __SANITIZE_THREAD__
char begin_tag, end_tag;
void tell_begin() { __tsan_release(&begin_tag); }
void tell_range_begins() { __tsan_acquire(&begin_tag); }
void tell_range_ends() { __tsan_release(&end_tag); }
void tell_end() { __tsan_acquire(&end_tag); }
#else
void tell_begin() {}
void tell_range_begins() {}
void tell_range_ends() {}
void tell_end() {}
#endif

// Calls f with at most this number of threads: in the present arena if it is small enough, because
// a new one costs time. The calling thread is isolated while it waits, so that it does not take
// other tasks that would use its scratch memory.
template <typename F>
void in_arena(int threads, const F& f) {
  if (tbb::this_task_arena::max_concurrency() <= threads) return tbb::this_task_arena::isolate(f);
  tbb::task_arena arena(threads);
  arena.execute(f);
}

}  // namespace

int hardware_threads() {
  const int allowed = allowed_cpus();
  const int cpus = allowed > 0 ? allowed : static_cast<int>(std::thread::hardware_concurrency());
  return threads_for(cpus, cpu_time_limit());
}

int thread_count(int wanted) { return wanted > 0 ? wanted : hardware_threads(); }

void parallel_ranges(size_t n, int threads, void (*body)(void*, size_t, size_t), void* context) {
  if (threads <= 1 || n < 2) {
    body(context, 0, n);
    return;
  }
  // Small ranges balance uneven work (a particle in mid-air costs less than one at a heel strike);
  // 8 for each thread keep the overhead small.
  const size_t grain = std::max<size_t>(1, n / (static_cast<size_t>(threads) * 8));
  tell_begin();
  in_arena(threads, [&] {
    tbb::parallel_for(
        tbb::blocked_range<size_t>(0, n, grain),
        // The captured variables were written by TBB's task, whose synchronisation the thread
        // sanitizer does not see; it does see that of `body`.
        [&](const tbb::blocked_range<size_t>& range) __attribute__((no_sanitize("thread"))) {
          tell_range_begins();
          body(context, range.begin(), range.end());
          tell_range_ends();
        },
        tbb::simple_partitioner());
  });
  tell_end();
}

void run_beside(int threads, const std::function<void()>& here,
                const std::function<void()>& beside) {
  if (threads <= 1) {
    here();
    beside();
    return;
  }
  std::exception_ptr thrown;
  const auto attempt = [&](const std::function<void()>& f) {
    try {
      f();
    } catch (...) {
      if (!thrown) thrown = std::current_exception();
    }
  };
  tell_begin();
  in_arena(threads, [&] {
    tbb::task_group group;
    group.run([&] {
      tell_range_begins();
      beside();
      tell_range_ends();
    });
    attempt(here);
    // Runs here if no other thread was free.
    attempt([&] { group.wait(); });
  });
  tell_end();
  if (thrown) std::rethrow_exception(thrown);
}

}  // namespace core
}  // namespace walktrack
