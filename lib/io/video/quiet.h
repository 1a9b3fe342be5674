// Decoders of images (libpng, libjpeg) complain straight to the terminal, of profiles that nobody
// asked for and without a file's name. While a QuietDecoders lives, in any thread, what is written
// to stderr goes nowhere; what a decoder makes of a file is said by who called it.
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
