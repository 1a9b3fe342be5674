// Sizes are read from any bytes; small images are decoded too. The decoders are OpenCV's: faults in
// them are not ours to find, but their exceptions are ours to catch.
#include "io/video/image_size.h"

#include <cstdlib>

#include <opencv2/core/mat.hpp>

#include "io/video/video.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  using namespace walktrack;
  constexpr int64_t kMostPixels = 4096;  // that are worth the time to decode
  const auto image_size = image_size_from_header({bytes, size});
  if (!image_size) return 0;
  if (image_size->width < 1 || image_size->height < 1) std::abort();
  if (image_size->width > kMostPixels / image_size->height) return 0;
  const auto file = scratch_file("image.png", text_of(bytes, size));
  cv::Mat image;
  expect_value_or_error([&] {
    if (read_image_file(file, image).empty() && image.empty()) std::abort();
  });
  return 0;
}
