// The CPU time of decoding a frame of the demo alone, and with its conversion to the colours of
// OpenCV: the machine's limits for reading.
#include <benchmark/benchmark.h>

#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

#include "tests/bench/legs.h"

namespace walktrack {
namespace {

// Calls next(capture) for every frame.
template <typename Next>
void each_frame(benchmark::State& state, const Next& next) {
  double frames = 0;
  for (auto _ : state) {
    cv::VideoCapture capture(WALKTRACK_DEMO "/side.mp4", cv::CAP_FFMPEG);
    for (frames = 0; next(capture); ++frames) continue;
  }
  if (frames == 0) return state.SkipWithError("the demo's video cannot be read");
  set_items(state, frames);
}

void decoded_frame(benchmark::State& state) {
  each_frame(state, [](cv::VideoCapture& capture) { return capture.grab(); });
}
BENCHMARK(decoded_frame)->MeasureProcessCPUTime();

void converted_frame(benchmark::State& state) {
  cv::Mat picture;
  each_frame(state, [&](cv::VideoCapture& capture) { return capture.read(picture); });
}
BENCHMARK(converted_frame)->MeasureProcessCPUTime();

}  // namespace
}  // namespace walktrack
