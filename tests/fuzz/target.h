// Common parts of fuzz targets. A target takes any bytes: the reader may accept them or refuse them
// with an error for the user; another exception, a fault that a sanitizer detects, or a hang is a
// finding.
//
// With libFuzzer (preset `fuzz`) bytes come from its mutations, in every other build from the files
// of corpus/ (replay.cpp).
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

// Runs a reader, which may throw errors for the user.
template <typename Read>
void expect_value_or_error(Read read) {
  try {
    read();
  } catch (const InputError&) {
  } catch (const UsageError&) {
  }
}

// A folder of this process in memory or, failing that, among temporary files; removed at exit.
const std::filesystem::path& scratch_folder();

// Writes a file there and returns its path; an existing one is overwritten.
std::filesystem::path scratch_file(std::string_view name, std::string_view content);

}  // namespace walktrack
