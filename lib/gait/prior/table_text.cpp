#include "gait/prior/table_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "core/errors.h"

namespace walktrack {
inline namespace gait {
namespace {

// FNV-1a, 64 bits: detects truncation and editing, not forgery.
std::string checksum_line(std::string_view text) {
  uint64_t hash = 14695981039346656037ull;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  return fmt::format("checksum {:016x}", hash);
}

void write_axis(std::string& text, std::string_view name, const std::vector<double>& axis) {
  auto out = std::back_inserter(text);
  fmt::format_to(out, "{} {}", name, axis.size());
  for (const double value : axis) fmt::format_to(out, " {:.10g}", value);
  text += '\n';
}

}  // namespace

void TableReader::head(std::string_view version_line) {
  const auto found = line();
  if (found != version_line) fail(fmt::format("'{}'", found), fmt::format("'{}'", version_line));
  line();
}

void TableReader::axes(PriorAxes& axes) {
  axes.speeds = axis("speeds");
  axes.ratios = axis("ratios");
  axes.slopes = axis("slopes");
  if (axes.size() > text_.size())
    fail(fmt::format("{} nodes", axes.size()), "a line for each node");
}

double TableReader::number() {
  const auto text = word();
  double value = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
    fail(fmt::format("'{}'", text), "a number");
  return value;
}

void TableReader::numbers(std::span<double> values) {
  for (double& value : values) value = number();
}

void TableReader::checksum() {
  const std::string expected = checksum_line(text_.substr(0, at_));
  const auto found = line();
  if (found != expected) fail(fmt::format("'{}'", found), fmt::format("'{}'", expected));
}

std::string_view TableReader::line() {
  const size_t end = std::min(text_.find('\n', at_), text_.size());
  const auto result = text_.substr(at_, end - at_);
  at_ = std::min(end + 1, text_.size());
  ++line_;
  return result;
}

std::string_view TableReader::word() {
  rest_.remove_prefix(std::min(rest_.find_first_not_of(' '), rest_.size()));
  const auto result = rest_.substr(0, std::min(rest_.find(' '), rest_.size()));
  rest_.remove_prefix(result.size());
  return result;
}

std::vector<double> TableReader::axis(std::string_view name) {
  begin_line();
  const auto found = word();
  if (found != name) fail(fmt::format("'{}'", found), fmt::format("'{}'", name));
  const double size = number();
  if (!(size >= 1 && size <= 1000 && size == std::floor(size)))
    fail(fmt::format("{}", size), "1 to 1000 values");
  std::vector<double> axis(static_cast<size_t>(size));
  numbers(axis);
  return axis;
}

void TableReader::fail(std::string_view found, std::string_view allowed) const {
  throw InputError(describe({name_, line_, ""}, found, allowed));
}

std::string table_head(std::string_view version_line, std::string_view tool_version,
                       const PriorAxes& axes) {
  std::string text = fmt::format("{}\nwritten by walktrack {}\n", version_line, tool_version);
  write_axis(text, "speeds", axes.speeds);
  write_axis(text, "ratios", axes.ratios);
  write_axis(text, "slopes", axes.slopes);
  return text;
}

std::string with_checksum(std::string text) { return text + checksum_line(text) + '\n'; }

}  // namespace gait
}  // namespace walktrack
