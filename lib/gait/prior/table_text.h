// What the files of all tables of gaits have in common: a version line, who wrote it, the axes, one
// line a node, and a checksum of all that; internal to lib/gait.
#pragma once

#include <span>
#include <string>
#include <string_view>

#include "gait/prior/prior_table.h"

namespace walktrack {
inline namespace gait {

// Reads words of a text in order; every failure is an InputError that names the place.
class TableReader {
 public:
  // `name` stands in messages and outlives the reader.
  TableReader(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  // The version line, which must be this one, and the line of who wrote it.
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

// The same lines, written.
std::string table_head(std::string_view version_line, std::string_view tool_version,
                       const PriorAxes& axes);
std::string with_checksum(std::string text);

}  // namespace gait
}  // namespace walktrack
