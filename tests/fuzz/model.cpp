#include "io/scene/model_file.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  using namespace walktrack;
  const std::string file = scratch_file("model.yaml", text_of(bytes, size)).string();
  expect_value_or_error([&] {
    const std::string text = model_as_yaml(read_model("", file, {}));
    const std::string again = scratch_file("again.yaml", text).string();
    if (model_as_yaml(read_model("", again, {})) != text) __builtin_trap();
  });
  return 0;
}
