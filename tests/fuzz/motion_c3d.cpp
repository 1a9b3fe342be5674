#include "io/tables/motion_file.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  using namespace walktrack;
  const auto file = scratch_file("joints.c3d", text_of(bytes, size));
  expect_value_or_error([&] { motion_csv(read_motion(file)); });
  return 0;
}
