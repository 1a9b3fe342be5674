// The time of the built-in pose network alone for one cut-out: the peer of `walktrack track` with
// the network in every frame, on as many threads as that uses for it.
#include <benchmark/benchmark.h>

#include <fstream>
#include <iterator>
#include <string>

#include <opencv2/core.hpp>

#include "observation/pose_net/pose_net.h"
#include "tests/bench/legs.h"

namespace walktrack {
namespace {

std::string shipped_network() {
  std::ifstream file(WALKTRACK_NETWORK, std::ios::binary);
  return {std::istreambuf_iterator<char>(file), {}};
}

void pose_network(benchmark::State& state) {
  if (!has_pose_net()) return state.SkipWithError("built without OpenCV's dnn module");
  cv::setNumThreads(1);
  PoseNet net(shipped_network(), WALKTRACK_NETWORK);
  cv::Mat picture(480, 640, CV_8UC3);
  cv::randu(picture, 0, 255);  // the time does not depend on the image
  for (auto _ : state) benchmark::DoNotOptimize(net.detect({picture}, {160, 40, 400}));
  set_items(state, 1);
}
BENCHMARK(pose_network);

}  // namespace
}  // namespace walktrack
