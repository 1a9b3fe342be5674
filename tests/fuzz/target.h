// What every fuzz target shares. A target takes any bytes: the reader may take or refuse them with
// an error for the user; another exception, a fault that a sanitizer sees, or a hang is a finding.
//
// Under libFuzzer (preset `fuzz`) bytes come from its mutations, in every other build from the
// files of corpus/ (replay.cpp).
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <string_view>

#include "core/errors.h"

extern "C" int LLVMFuzzerTestOneInput(const uint8_t* bytes, size_t size);

namespace walktrack {

inline std::string_view text_of(const uint8_t* bytes, size_t size) {
  return {reinterpret_cast<const char*>(bytes), size};
}

// Runs a reader; errors for the user are its right.
template <typename Read>
void expect_value_or_error(Read read) {
  try {
    read();
  } catch (const InputError&) {
  } catch (const UsageError&) {
  }
}

// A folder of this process in memory or, failing that, the place for temporary files; removed at
// its exit.
const std::filesystem::path& scratch_folder();

// Writes a file there and returns its path; one that stands there is overwritten.
std::filesystem::path scratch_file(std::string_view name, std::string_view content);

}  // namespace walktrack
