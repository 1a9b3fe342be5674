#include <string>

#include "io/calibration/formats/toml.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  using namespace walktrack;
  expect_value_or_error(
      [&] { camera_from_toml(std::string(text_of(bytes, size)), "fuzz.toml", "a"); });
  return 0;
}
