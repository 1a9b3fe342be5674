#include "tests/io/json_schema.h"

#include <regex>
#include <set>
#include <stdexcept>

namespace walktrack {

namespace {

using Json = nlohmann::json;

const std::set<std::string> kKnown{"$schema",    "$id",      "title",
                                   "$defs",      "$ref",     "type",
                                   "properties", "required", "additionalProperties",
                                   "items",      "minItems", "maxItems",
                                   "minimum",    "maximum",  "enum",
                                   "const",      "anyOf",    "pattern"};

bool is_type(const Json& value, const std::string& type) {
  if (type == "object") return value.is_object();
  if (type == "array") return value.is_array();
  if (type == "string") return value.is_string();
  if (type == "boolean") return value.is_boolean();
  if (type == "null") return value.is_null();
  if (type == "number") return value.is_number();
  if (type == "integer") return value.is_number_integer();
  throw std::logic_error("unknown type " + type);
}

class Check {
 public:
  explicit Check(const Json& root) : root_(root) {}

  std::string trouble(const Json& schema, const Json& value, const std::string& at) const {
    for (const auto& [key, unused] : schema.items())
      if (!kKnown.contains(key)) throw std::logic_error("unknown keyword " + key);
    if (schema.contains("$ref")) {
      const std::string ref = schema["$ref"];
      return trouble(root_.at(Json::json_pointer(ref.substr(1))), value, at);
    }
    for (const auto part :
         {&Check::type, &Check::limits, &Check::alternatives, &Check::object, &Check::list}) {
      std::string found = (this->*part)(schema, value, at);
      if (!found.empty()) return found;
    }
    return "";
  }

 private:
  std::string type(const Json& schema, const Json& value, const std::string& at) const {
    if (!schema.contains("type")) return "";
    const Json types = schema["type"].is_array() ? schema["type"] : Json::array({schema["type"]});
    for (const Json& each : types)
      if (is_type(value, each)) return "";
    return at + ": is no " + types.dump();
  }

  std::string limits(const Json& schema, const Json& value, const std::string& at) const {
    if (schema.contains("const") && value != schema["const"]) return at + ": another value";
    if (schema.contains("enum")) {
      bool found = false;
      for (const Json& each : schema["enum"]) found = found || each == value;
      if (!found) return at + ": is none of " + schema["enum"].dump();
    }
    if (value.is_number() && schema.contains("minimum") && value < schema["minimum"])
      return at + ": too small";
    if (value.is_number() && schema.contains("maximum") && value > schema["maximum"])
      return at + ": too large";
    if (value.is_string() && schema.contains("pattern") &&
        !std::regex_search(value.get<std::string>(),
                           std::regex(schema["pattern"].get<std::string>())))
      return at + ": another pattern";
    return "";
  }

  std::string alternatives(const Json& schema, const Json& value, const std::string& at) const {
    if (!schema.contains("anyOf")) return "";
    for (const Json& each : schema["anyOf"])
      if (trouble(each, value, at).empty()) return "";
    return at + ": none of the alternatives";
  }

  std::string object(const Json& schema, const Json& value, const std::string& at) const {
    if (!value.is_object()) return "";
    for (const Json& key : schema.value("required", Json::array()))
      if (!value.contains(key.get<std::string>())) return at + ": lacks " + key.dump();
    const Json properties = schema.value("properties", Json::object());
    const Json others = schema.value("additionalProperties", Json(true));
    for (const auto& [key, each] : value.items()) {
      const std::string below = at + "/" + key;
      if (properties.contains(key)) {
        if (auto found = trouble(properties[key], each, below); !found.empty()) return found;
      } else if (others.is_object()) {
        if (auto found = trouble(others, each, below); !found.empty()) return found;
      } else if (!others.get<bool>()) {
        return below + ": an unknown key";
      }
    }
    return "";
  }

  std::string list(const Json& schema, const Json& value, const std::string& at) const {
    if (!value.is_array()) return "";
    if (value.size() < schema.value("minItems", size_t{0})) return at + ": too short";
    if (schema.contains("maxItems") && value.size() > schema["maxItems"]) return at + ": too long";
    if (!schema.contains("items")) return "";
    for (size_t i = 0; i < value.size(); ++i)
      if (auto found = trouble(schema["items"], value[i], at + "/" + std::to_string(i));
          !found.empty())
        return found;
    return "";
  }

  const Json& root_;
};

}  // namespace

std::string schema_trouble(const Json& schema, const Json& value) {
  return Check(schema).trouble(schema, value, "");
}

}  // namespace walktrack
