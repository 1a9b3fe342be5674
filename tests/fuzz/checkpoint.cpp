// The part after a checkpoint's digest: any bytes, and a valid checkpoint with some bytes changed.
#include "io/archive/checkpoint_file.h"
#include "tests/fuzz/edited.h"
#include "tests/fuzz/target.h"
#include "tests/io/sample_state.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size) {
  using namespace walktrack;
  static const std::string sound = checkpoint_bytes(sample_checkpoint({}));
  for (const std::string& text : {std::string(text_of(bytes, size)), edited(sound, bytes, size)}) {
    const FoundCheckpoint found = parse_checkpoint(text, "checkpoint.bin", {});
    // A checkpoint that is accepted is written as it was read.
    if (found.checkpoint && checkpoint_bytes(*found.checkpoint) != text) __builtin_trap();
  }
  return 0;
}
