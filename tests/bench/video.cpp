// The CPU time of decoding a frame of the demo alone, and with its conversion to colours: the
// machine's limits for reading.
#include <benchmark/benchmark.h>

#include <opencv2/core/mat.hpp>

#include "io/video/video.h"
#include "tests/bench/legs.h"

namespace walktrack {
namespace {

// Calls next(source) for every frame.
template <typename Next>
void each_frame(benchmark::State& state, const Next& next) {
  double frames = 0;
  for (auto _ : state) {
    FrameSource source(WALKTRACK_DEMO "/side.mp4");
    for (frames = 0; next(source); ++frames) continue;
  }
  if (frames == 0) return state.SkipWithError("the demo's video cannot be read");
  set_items(state, frames);
}

void decoded_frame(benchmark::State& state) {
  each_frame(state, [](FrameSource& source) { return source.advance(); });
}
BENCHMARK(decoded_frame)->MeasureProcessCPUTime();

void converted_frame(benchmark::State& state) {
  cv::Mat picture;
  each_frame(state, [&](FrameSource& source) { return source.read(picture); });
}
BENCHMARK(converted_frame)->MeasureProcessCPUTime();

}  // namespace
}  // namespace walktrack
