// Common parts of the files of all tables of gaits: a version line, the program that wrote it, the
// axes, one line for each node, and a checksum; internal to lib/gait.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "gait/prior/prior_table.h"

namespace walktrack {
inline namespace gait {

// Reads words of a text in order; every error is an InputError that names the place.
class TableReader {
 public:
  // `name` is used in messages and has to outlive the reader.
  TableReader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  // Reads the version line, which must be this one, and the line with the program that wrote it.
  void head(std::string_view version_line);
  void axes(PriorAxes& axes);
  void begin_line() { rest_ = line(); }
  double number();
  void numbers(std::span<double> values);
  // The last line: the checksum of everything before it.
  void checksum();

 private:
  std::string_view line();
  std::string_view word();
  std::vector<double> axis(std::string_view name);
  [[noreturn]] void fail(std::string_view found, std::string_view allowed) const;

  std::string_view text_, rest_;
  const std::string& name_;
  size_t at_ = 0;
  int line_ = 0;
};

// Writes the same lines.
std::string table_head(std::string_view version_line, std::string_view tool_version,
                       const PriorAxes& axes);
std::string with_checksum(std::string text);

}  // namespace gait
}  // namespace walktrack
