#include "io/config/yaml.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <limits>
#include <set>
#include <sstream>

#include <fmt/format.h>
#include <yaml-cpp/eventhandler.h>

#include "core/errors.h"
#include "io/archive/files.h"

namespace walktrack {
inline namespace io {

namespace {

// Refuses keys that appear twice in a map, of which the parser would silently take one. It works on
// the parser's events, so that the content of anchors is seen once.
class KeysOnce : public YAML::EventHandler {
 public:
  explicit KeysOnce(std::string file) : file_(std::move(file)) {}

  void OnDocumentStart(const YAML::Mark&) override {}
  void OnDocumentEnd() override {}
  void OnNull(const YAML::Mark& mark, YAML::anchor_t) override { scalar(mark, ""); }
  void OnAlias(const YAML::Mark&, YAML::anchor_t) override { value(); }
  void OnScalar(const YAML::Mark& mark, const std::string&, YAML::anchor_t,
                const std::string& text) override {
    scalar(mark, text);
  }
  void OnSequenceStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                       YAML::EmitterStyle::value) override {
    open(false);
  }
  void OnSequenceEnd() override { open_.pop_back(); }
  void OnMapStart(const YAML::Mark&, const std::string&, YAML::anchor_t,
                  YAML::EmitterStyle::value) override {
    open(true);
  }
  void OnMapEnd() override { open_.pop_back(); }

 private:
  struct Open {
    std::string path;  // dotted path of the map or list
    bool map;
    bool at_key = true;
    size_t items = 0;  // number of items of a list
    std::set<std::string> keys;
    std::string key;  // key of the next value
  };

  // The dotted path of the next value.
  std::string path() const {
    if (open_.empty()) return "";
    const Open& in = open_.back();
    if (!in.map) return fmt::format("{}[{}]", in.path, in.items);
    return in.path.empty() ? in.key : in.path + "." + in.key;
  }

  void open(bool map) {
    const std::string here = path();
    value();
    open_.push_back({here, map, true, 0, {}, {}});
  }

  void value() {
    if (open_.empty()) return;
    open_.back().at_key = !open_.back().at_key;
    ++open_.back().items;
  }

  void scalar(const YAML::Mark& mark, const std::string& text) {
    if (!open_.empty() && open_.back().map && open_.back().at_key) {
      Open& in = open_.back();
      in.key = text;
      if (!in.keys.insert(text).second)
        throw InputError(describe({file_, mark.line + 1, path()}, "the key twice", "once"));
    }
    value();
  }

  std::string file_;
  std::vector<Open> open_;
};

// Refuses a second document and duplicate keys.
void refuse_silent_losses(const std::string& text, const std::string& name) {
  std::istringstream stream(text);
  YAML::Parser parser(stream);
  KeysOnce once(name);
  if (!parser.HandleNextDocument(once)) return;
  class More : public KeysOnce {
   public:
    using KeysOnce::KeysOnce;
    int line = 0;
    void OnDocumentStart(const YAML::Mark& mark) override { line = mark.line + 1; }
  } more(name);
  if (parser.HandleNextDocument(more))
    throw InputError(describe({name, more.line, ""}, "a second YAML document", "one a file"));
}

// The beginning of what was found, of which a message shows so much: a table that is given in place
// of a scene is one long word. No character of several bytes is cut.
std::string beginning_of(std::string_view found) {
  constexpr size_t kMostShown = 80;
  if (found.size() <= kMostShown) return std::string(found);
  size_t end = kMostShown;
  while (end > 0 && (static_cast<unsigned char>(found[end]) & 0xC0) == 0x80) --end;
  return std::string(found.substr(0, end)) + "...";
}

}  // namespace

YamlValue YamlValue::from_file(const std::string& path) {
  return from_text(read_text_file(path, kMaxYamlBytes), path);
}

YamlValue YamlValue::from_text(const std::string& text, const std::string& name) {
  try {
    refuse_silent_losses(text, name);
    YAML::Node node = YAML::Load(text);
    if (!node.IsDefined() || node.IsNull()) node = YAML::Node(YAML::NodeType::Map);
    return {node, name, ""};
  } catch (const YAML::Exception& error) {
    if (text.find('\0') != std::string::npos)
      throw InputError(describe({name, 0, ""}, "bytes that are no text", "a text in YAML"));
    throw InputError(describe({name, error.mark.is_null() ? 0 : error.mark.line + 1, ""},
                              fmt::format("broken YAML ({})", error.msg), ""));
  }
}

int YamlValue::line() const {
  const YAML::Mark mark = node_.Mark();
  return mark.is_null() ? 0 : mark.line + 1;
}

void YamlValue::fail(std::string_view found, std::string_view allowed) const {
  throw InputError(describe({file_, line(), key_}, beginning_of(found), allowed));
}

std::string YamlValue::describe_found() const {
  if (node_.IsSequence()) return "a list";
  if (node_.IsMap()) return "a map";
  if (node_.IsScalar()) return fmt::format("'{}'", node_.Scalar());
  return "nothing";
}

std::vector<std::string> YamlValue::keys() const {
  if (!is_map()) fail(describe_found(), "a map of keys");
  std::vector<std::string> found;
  for (const auto& entry : node_) {
    const YamlValue key(entry.first, file_, key_);
    if (!key.is_scalar()) key.fail("a key that is no word", "words as keys");
    found.push_back(entry.first.Scalar());
  }
  return found;
}

void YamlValue::only_keys(const std::vector<std::string>& allowed) const {
  for (const auto& entry : node_.IsMap() ? node_ : (keys(), node_)) {
    const std::string name = entry.first.IsScalar() ? entry.first.Scalar() : "";
    const YamlValue place(entry.first, file_, key_.empty() ? name : key_ + "." + name);
    if (std::find(allowed.begin(), allowed.end(), name) != allowed.end()) continue;
    const std::string nearest = nearest_word(name, allowed);
    place.fail(nearest.empty() ? "an unknown key"
                               : fmt::format("an unknown key, did you mean '{}'?", nearest),
               fmt::format("{}", fmt::join(allowed, ", ")));
  }
}

bool YamlValue::has(const std::string& key) const {
  if (!is_map()) fail(describe_found(), "a map of keys");
  const YAML::Node child = node_[key];
  return child.IsDefined() && !child.IsNull();
}

YamlValue YamlValue::at(const std::string& key) const {
  const std::string path = key_.empty() ? key : key_ + "." + key;
  if (!has(key)) {
    throw InputError(describe({file_, line(), path}, "nothing", "this key is required"));
  }
  return {node_[key], file_, path};
}

std::vector<YamlValue> YamlValue::items() const {
  if (!is_list()) fail(describe_found(), "a list");
  std::vector<YamlValue> found;
  for (size_t i = 0; i < node_.size(); ++i) {
    found.push_back({node_[i], file_, fmt::format("{}[{}]", key_, i)});
  }
  return found;
}

std::string YamlValue::text() const {
  if (!is_scalar() || node_.Scalar().empty()) fail(describe_found(), "a word or text");
  return node_.Scalar();
}

double YamlValue::number() const {
  constexpr double kLargest = std::numeric_limits<double>::max();
  return number(-kLargest, kLargest);
}

std::string YamlValue::name() const {
  constexpr size_t kLongest = 100;
  std::string name = text();
  const bool plain = std::none_of(name.begin(), name.end(), [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 || byte == 0x7f || c == '/' || c == '\\';
  });
  if (!plain || name[0] == '.' || name.size() > kLongest) {
    fail(fmt::format("'{}'", name),
         "up to 100 characters without slashes and control characters, no leading dot");
  }
  return name;
}

double YamlValue::number(double lowest, double highest) const {
  constexpr double kLargest = std::numeric_limits<double>::max();
  const std::string range = lowest == -kLargest && highest == kLargest
                                ? std::string("a number")
                                : fmt::format("a number from {:g} to {:g}", lowest, highest);
  const auto value = is_scalar() ? number_from_text(node_.Scalar()) : std::nullopt;
  if (!value || !(*value >= lowest && *value <= highest)) fail(describe_found(), range);
  return *value;
}

int YamlValue::integer(int lowest, int highest) const {
  const auto value = is_scalar() ? number_from_text(node_.Scalar()) : std::nullopt;
  if (!value || *value != std::floor(*value) || *value < lowest || *value > highest) {
    fail(describe_found(), fmt::format("a whole number from {} to {}", lowest, highest));
  }
  return static_cast<int>(*value);
}

std::vector<double> YamlValue::numbers() const {
  if (!is_list()) fail(describe_found(), "a list of numbers");
  std::vector<double> found;
  for (const YamlValue& item : items()) found.push_back(item.number());
  return found;
}

std::vector<double> YamlValue::numbers(size_t count) const {
  const std::string allowed = fmt::format("a list of {} numbers", count);
  if (!is_list()) fail(describe_found(), allowed);
  std::vector<double> found = numbers();
  if (found.size() != count) fail(fmt::format("{} numbers", found.size()), allowed);
  return found;
}

}  // namespace io
}  // namespace walktrack
