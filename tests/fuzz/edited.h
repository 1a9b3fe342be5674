// Valid bytes with some of them replaced according to a fuzz target's input: two bytes for the
// place, one for the value, and so on. This reaches code that random bytes hardly reach, for any
// version of the format.
#pragma once

#include <cstdint>
#include <string>

namespace walktrack {

inline std::string edited(std::string bytes, const uint8_t* edits, size_t size) {
  for (; size >= 3 && !bytes.empty(); edits += 3, size -= 3) {
    const size_t place = size_t{edits[0]} * 256 + edits[1];
    bytes[place % bytes.size()] = static_cast<char>(edits[2]);
  }
  return bytes;
}

}  // namespace walktrack
