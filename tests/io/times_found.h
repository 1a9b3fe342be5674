// How often a text holds another, for the tests of drawings.
#pragma once

#include <string>

namespace walktrack {

inline size_t times_found(const std::string& text, const std::string& part) {
  size_t n = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

}  // namespace walktrack
