// Sizes are read from any bytes; small images are decoded, too. Faults in OpenCV's decoders are not
// tested here, but their exceptions have to be caught.
#include "io/video/image_size.h"

#include <cstdlib>

#include <opencv2/core/mat.hpp>

#include "io/video/image_files.h"
#include "tests/fuzz/target.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  using namespace walktrack;
  constexpr int64_t kMostPixels = 4096;  // limit of images that are decoded
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
