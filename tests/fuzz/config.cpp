#include "io/config/config.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  using namespace walktrack;
  const std::string file = scratch_file("config.yaml", text_of(bytes, size)).string();
  expect_value_or_error([&] {
    ConfigWithOrigin config;
    apply_config_file(config, file);
    config_as_yaml(config, ConfigScope::kChanged, false);
  });
  return 0;
}
