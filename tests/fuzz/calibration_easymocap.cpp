// One text is used for both files, because their keys differ.
#include <string>

#include "io/calibration/calibration.h"
#include "io/calibration/formats/easymocap.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  using namespace walktrack;
  const std::string text(text_of(bytes, size));
  expect_value_or_error([&] {
    if (!is_easymocap(text, "intri.yml")) return;
    for (const std::string& name : easymocap_names(text, "intri.yml"))
      expect_value_or_error([&] {
        camera_from_easymocap({text, "intri.yml"}, {text, "extri.yml"}, name, ImageSize{640, 480});
      });
  });
  return 0;
}
