#include <string>

#include "io/calibration/calibration.h"
#include "io/calibration/formats/humaneva.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  using namespace walktrack;
  expect_value_or_error([&] {
    camera_from_humaneva(std::string(text_of(bytes, size)), "fuzz.cal", ImageSize{640, 480});
  });
  return 0;
}
