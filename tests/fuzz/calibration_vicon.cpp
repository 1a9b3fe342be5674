#include <string>

#include "io/calibration/formats/vicon.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  using namespace walktrack;
  const std::string text(text_of(bytes, size));
  expect_value_or_error([&] {
    for (const std::string& name : vicon_names(text, "fuzz.xcp"))
      expect_value_or_error([&] { camera_from_vicon(text, "fuzz.xcp", name); });
  });
  return 0;
}
