#include <string>

#include "io/calibration/formats/tsai.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  using namespace walktrack;
  expect_value_or_error([&] { camera_from_tsai(std::string(text_of(bytes, size)), "fuzz.xml"); });
  return 0;
}
