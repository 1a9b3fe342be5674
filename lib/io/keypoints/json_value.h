// A value in a JSON file with its place. Values are asked for by key and type; a wrong one is an
// InputError "file: key: found X, allowed Y". Copies are cheap; the content of the file has to
// outlive them.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include <nlohmann/json.hpp>

namespace walktrack {
inline namespace io {

// "NaN" and "Infinity", which Python writes although they are not valid JSON, become null.
nlohmann::json json_from_text(std::string text, const std::string& file);

class JsonValue {
 public:
  JsonValue(const nlohmann::json& value, const std::string& file, std::string key = "")
      : value_(&value), file_(&file), key_(std::move(key)) {}

  bool is_map() const { return value_->is_object(); }
  bool is_list() const { return value_->is_array(); }
  bool is_text() const { return value_->is_string(); }
  size_t size() const { return value_->size(); }

  bool has(const char* key) const;
  JsonValue at(const char* key) const;   // of a map
  std::vector<JsonValue> items() const;  // of a list

  std::string text() const;
  int integer(int lowest, int highest) const;
  // A list of numbers; NaN for null.
  std::vector<double> numbers() const;

  [[noreturn]] void fail(std::string_view found, std::string_view allowed) const;

 private:
  std::string describe_found() const;

  const nlohmann::json* value_;
  const std::string* file_;
  std::string key_;
};

}  // namespace io
}  // namespace walktrack
