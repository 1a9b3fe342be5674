#include "io/keypoints/json_value.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/errors.h"

namespace walktrack {
inline namespace io {

using AnyJson = nlohmann::json;

namespace {

// This also replaces words inside names, which does no harm: only the digits of names are used.
void replace_all(std::string& text, std::string_view word, std::string_view by) {
  for (size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + by.size()))
    text.replace(at, word.size(), by);
}

int line_of(const std::string& text, size_t byte) {
  const auto end = text.begin() + static_cast<long>(std::min(byte, text.size()));
  return 1 + static_cast<int>(std::count(text.begin(), end, '\n'));
}

}  // namespace

AnyJson json_from_text(std::string text, const std::string& file) {
  replace_all(text, "-Infinity", "null");
  replace_all(text, "Infinity", "null");
  replace_all(text, "NaN", "null");
  try {
    return AnyJson::parse(text);
  } catch (const AnyJson::parse_error& error) {
    const int line = line_of(text, error.byte > 0 ? error.byte - 1 : 0);
    throw InputError(describe({file, line, ""}, "no JSON", "a complete JSON file"));
  } catch (const AnyJson::exception&) {
    throw InputError(describe({file, 0, ""}, "a number that is too large", "pixels"));
  }
}

bool JsonValue::has(const char* key) const { return is_map() && value_->contains(key); }

JsonValue JsonValue::at(const char* key) const {
  if (!is_map()) fail(describe_found(), fmt::format("a map with '{}'", key));
  const auto found = value_->find(key);
  if (found == value_->end()) fail(fmt::format("no '{}'", key), "it");
  return {*found, *file_, key_.empty() ? key : fmt::format("{}.{}", key_, key)};
}

std::vector<JsonValue> JsonValue::items() const {
  if (!is_list()) fail(describe_found(), "a list");
  std::vector<JsonValue> out;
  out.reserve(value_->size());
  for (const AnyJson& item : *value_)
    out.emplace_back(item, *file_, fmt::format("{}[{}]", key_, out.size()));
  return out;
}

std::string JsonValue::text() const {
  if (!is_text()) fail(describe_found(), "a text");
  return value_->get<std::string>();
}

int JsonValue::integer(int lowest, int highest) const {
  const bool whole =
      value_->is_number() && std::trunc(value_->get<double>()) == value_->get<double>();
  const double number = whole ? value_->get<double>() : 0;
  if (!whole || number < lowest || number > highest)
    fail(describe_found(), fmt::format("a whole number from {} to {}", lowest, highest));
  return static_cast<int>(number);
}

std::vector<double> JsonValue::numbers() const {
  if (!is_list()) fail(describe_found(), "a list of numbers");
  std::vector<double> out;
  out.reserve(value_->size());
  for (const AnyJson& item : *value_) {
    if (!item.is_number() && !item.is_null())
      JsonValue(item, *file_, fmt::format("{}[{}]", key_, out.size()))
          .fail(JsonValue(item, *file_).describe_found(), "a number");
    out.push_back(item.is_null() ? std::numeric_limits<double>::quiet_NaN() : item.get<double>());
  }
  return out;
}

void JsonValue::fail(std::string_view found, std::string_view allowed) const {
  throw InputError(describe({*file_, 0, key_}, found, allowed));
}

std::string JsonValue::describe_found() const {
  if (is_map()) return "a map";
  if (is_list()) return "a list";
  const std::string text = value_->dump(-1, ' ', false, AnyJson::error_handler_t::replace);
  constexpr size_t kLongest = 40;
  return text.size() > kLongest ? text.substr(0, kLongest) + "..." : text;
}

}  // namespace io
}  // namespace walktrack
