#include "io/config/parameters.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "io/archive/files.h"

namespace walktrack {
inline namespace io {

bool number_in_range(const std::string& text, double lowest, double highest, double& value) {
  const auto number = number_from_text(text);
  if (!number || !(*number >= lowest && *number <= highest)) return false;
  value = *number;
  return true;
}

bool integer_in_range(const std::string& text, int64_t lowest, int64_t highest, int64_t& value) {
  int64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number);
  if (error != std::errc() || end != text.data() + text.size()) return false;
  if (number < lowest || number > highest) return false;
  value = number;
  return true;
}

bool flag_from_text(const std::string& text, bool& value) {
  if (text != "true" && text != "false") return false;
  value = text == "true";
  return true;
}

std::string number_allowed(double lowest, double highest) {
  return fmt::format("a number from {:g} to {:g}", lowest, highest);
}

std::string integer_allowed(int64_t lowest, int64_t highest) {
  return fmt::format("a whole number from {} to {}", lowest, highest);
}

bool list_in_range(const std::string& text, size_t count, bool whole, double lowest, double highest,
                   std::vector<double>& values) {
  if (text.size() < 2 || text.front() != '[' || text.back() != ']') return false;
  for (size_t at = 1; at < text.size();) {
    const size_t end = std::min(text.find(',', at), text.size() - 1);
    double value = 0;
    if (!number_in_range(text.substr(at, end - at), lowest, highest, value)) return false;
    if (whole && value != std::floor(value)) return false;
    values.push_back(value);
    at = end + 1;
  }
  return values.size() == count;
}

std::string list_allowed(size_t count, bool whole, double lowest, double highest) {
  return fmt::format("a list of {} {} from {:g} to {:g}", count,
                     whole ? "whole numbers" : "numbers", lowest, highest);
}

std::string list_text(const std::vector<double>& values) {
  return fmt::format("[{}]", fmt::join(values, ", "));
}

std::string number_text(double value) { return shortest_number(value); }

}  // namespace io
}  // namespace walktrack
