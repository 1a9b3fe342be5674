#include "io/keypoints/keypoint_file.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  using namespace walktrack;
  const auto file = scratch_file("points", text_of(bytes, size));
  expect_value_or_error([&] {
    const KeypointFrames frames = read_keypoints({.path = file});
    keypoint_notes(frames, 10);
    Camera camera;
    camera.width_px = camera.height_px = 100;
    check_image_size(frames, {.path = file}, camera);
  });
  expect_value_or_error([&] { read_keypoints({.path = file, .names = {{"left_knee", "knee"}}}); });
  std::filesystem::create_directory(scratch_folder() / "frames");
  scratch_file("frames/v_000000000003_keypoints.json", text_of(bytes, size));
  expect_value_or_error([&] { read_keypoints({.path = scratch_folder() / "frames"}); });
  return 0;
}
