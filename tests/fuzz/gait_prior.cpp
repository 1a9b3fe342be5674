#include "gait/prior/prior_file.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  using namespace walktrack;
  expect_value_or_error([&] { parse_gait_prior(text_of(bytes, size), "fuzz.txt"); });
  expect_value_or_error([&] { parse_straight_prior(text_of(bytes, size), "fuzz.txt"); });
  return 0;
}
