// Strict reading of YAML: every value is asked for by key, type and range, and keys that nobody
// asked for are an error. All errors are InputErrors of the form "file:line: key: found X, allowed
// Y"; for an unknown key they name the nearest valid one.
#pragma once

#include <functional>
#include <string>
#include <string_view>
#include <vector>

#include <yaml-cpp/yaml.h>

namespace walktrack {
inline namespace io {

// A value in a YAML file with its place. Copies are cheap (yaml-cpp nodes are handles).
class YamlValue {
 public:
  // Reads a file of at most kMaxYamlBytes. An empty file is an empty map. Duplicate keys in a map
  // and a second document are errors.
  static YamlValue from_file(const std::string& path);
  static YamlValue from_text(const std::string& text, const std::string& name);

  const std::string& file() const { return file_; }
  const std::string& key() const { return key_; }  // dotted path, e.g. "cameras[0].video"
  int line() const;                                // counted from 1; 0 = not known
  bool is_map() const { return node_.IsMap(); }
  bool is_list() const { return node_.IsSequence(); }
  bool is_scalar() const { return node_.IsScalar(); }

  // For a map: a key that is not in `allowed` is an error.
  void only_keys(const std::vector<std::string>& allowed) const;
  std::vector<std::string> keys() const;
  bool has(const std::string& key) const;      // present and not null
  YamlValue at(const std::string& key) const;  // an error when missing
  // For a list: its items.
  std::vector<YamlValue> items() const;

  std::string text() const;  // a scalar that is not empty
  std::string name() const;  // a text that is valid in file names and pages
  double number(double lowest, double highest) const;
  double number() const;  // any finite number
  int integer(int lowest, int highest) const;
  std::vector<double> numbers() const;              // a list of finite numbers
  std::vector<double> numbers(size_t count) const;  // exactly that many

  // Throws the InputError for this value.
  [[noreturn]] void fail(std::string_view found, std::string_view allowed) const;
  std::string describe_found() const;  // "'text'", "a list", "a map", "nothing"

 private:
  YamlValue(const YAML::Node& node, std::string file, std::string key)
      : node_(node), file_(std::move(file)), key_(std::move(key)) {}
  YAML::Node node_;
  std::string file_, key_;
};

inline constexpr size_t kMaxYamlBytes = 16u << 20;

}  // namespace io
}  // namespace walktrack
