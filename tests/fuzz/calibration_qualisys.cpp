#include <string>

#include "io/calibration/formats/qualisys.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  using namespace walktrack;
  const std::string text(text_of(bytes, size));
  expect_value_or_error([&] {
    for (const std::string& name : qualisys_names(text, "fuzz.qca.txt"))
      expect_value_or_error([&] { camera_from_qualisys(text, "fuzz.qca.txt", name); });
  });
  return 0;
}
