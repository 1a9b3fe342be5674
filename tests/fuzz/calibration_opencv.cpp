#include <string>

#include "io/calibration/formats/opencv.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  using namespace walktrack;
  expect_value_or_error([&] {
    const Camera camera = camera_from_opencv(std::string(text_of(bytes, size)), "fuzz.yaml");
    camera_from_opencv(opencv_from_camera(camera), "again.yaml");
  });
  return 0;
}
