// A scene beside a camera file and a video, to which it may refer.
#include "io/scene/scene.h"
#include "tests/fuzz/target.h"
#include "tests/io/sample_files.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  using namespace walktrack;
  static const auto camera = scratch_file("a.yaml", kCalibrationText);
  static const auto video = scratch_file("a.mp4", "");
  const auto file = scratch_file("scene.yaml", text_of(bytes, size));
  expect_value_or_error([&] { read_scene(file); });
  return 0;
}
