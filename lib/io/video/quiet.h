// Image decoders (libpng, libjpeg) print warnings to stderr, without the file's name and about
// profiles that do not matter. While an instance of QuietDecoders exists in any thread, everything
// that is written to stderr is discarded; the caller of the decoder reports errors.
#pragma once

namespace walktrack {
inline namespace io {

class QuietDecoders {
 public:
  QuietDecoders();
  ~QuietDecoders();
  QuietDecoders(const QuietDecoders&) = delete;
  QuietDecoders& operator=(const QuietDecoders&) = delete;
};

}  // namespace io
}  // namespace walktrack
