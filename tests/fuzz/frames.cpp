// A file of frames: any bytes, and two valid records with some bytes changed.
#include "io/archive/files.h"
#include "io/archive/frame_file.h"
#include "tests/fuzz/edited.h"
#include "tests/fuzz/target.h"
#include "tests/io/sample_state.h"

namespace walktrack {
namespace {

constexpr size_t kRecords = 2;

std::string sound_file() {
  const auto path = scratch_file("sound.bin", "");
  FrameFile file(path);
  for (size_t i = 0; i < kRecords; ++i) file.append(sample_record());
  return read_text_file(path, size_t{1} << 20);
}

void read(std::string_view text) {
  const auto path = scratch_file("frames.bin", text);
  const std::string trouble = frame_file_trouble(path, kRecords, text.size());
  expect_value_or_error([&] {
    const FrameFile file(path, kRecords);
    for (size_t i = 0; i < kRecords; ++i) file[i];
    // The files that are read completely are those without an error.
    if (!trouble.empty() && file.bytes() == text.size()) __builtin_trap();
  });
}

}  // namespace
}  // namespace walktrack

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  using namespace walktrack;
  static const std::string sound = sound_file();
  const std::string_view text = text_of(bytes, size);
  expect_value_or_error([&] { frame_record_from_bytes(text, "frames.bin"); });
  read(edited(sound, bytes, size));
  return 0;
}
