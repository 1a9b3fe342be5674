#include "io/parameters.h"

#include <charconv>
#include <cmath>

#include <fmt/format.h>

#include "io/files.h"

namespace walktrack {

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

std::string number_text(double value) { return shortest_number(value); }

}  // namespace walktrack
