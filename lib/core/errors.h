// Errors that a user can cause and correct. The library throws them; only main() and the batch loop
// catch them. The exit code of the program follows from the type (see apps/main.cpp).
#pragma once

#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace walktrack {
inline namespace core {

// A usage or configuration mistake: exit code 2.
class UsageError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// An input file that cannot be read or does not fit: exit code 3.
class InputError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

// The place of a wrong value. Empty or zero parts are left out of the message.
struct InputPlace {
  std::string file;
  int line = 0;     // counted from 1
  std::string key;  // dotted path inside the file, e.g. "cameras[0].video"
};

// "file:line: key: found X, allowed Y", the form of every message about an input.
std::string describe(const InputPlace& place, std::string_view found, std::string_view allowed);

// The candidate nearest to `word` by edit distance (swapped neighbours are one edit), or "" if none
// is within a third of its length.
std::string nearest_word(std::string_view word, const std::vector<std::string>& candidates);

}  // namespace core
}  // namespace walktrack
