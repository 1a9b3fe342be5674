#include "gait/prior_file.h"

#include <fmt/format.h>

#include <charconv>
#include <cmath>
#include <cstdint>
#include <iterator>

#include "core/errors.h"

namespace walktrack {
namespace {

constexpr std::string_view kVersionLine = "walktrack gait prior, version 1";

// FNV-1a, 64 bits: guards against truncation and editing, not against malice.
uint64_t checksum(std::string_view text) {
  uint64_t hash = 14695981039346656037ull;
  for (const char c : text) hash = (hash ^ static_cast<unsigned char>(c)) * 1099511628211ull;
  return hash;
}

// Reads words of a text in order; every failure names the place.
class Words {
 public:
  Words(std::string_view text, const std::string& name) : text_(text), name_(name) {}

  std::string_view line() {
    const size_t end = std::min(text_.find('\n', at_), text_.size());
    const auto result = text_.substr(at_, end - at_);
    at_ = std::min(end + 1, text_.size());
    ++line_;
    return result;
  }

  void begin_line() { rest_ = line(); }

  std::string_view word() {
    rest_.remove_prefix(std::min(rest_.find_first_not_of(' '), rest_.size()));
    const auto result = rest_.substr(0, std::min(rest_.find(' '), rest_.size()));
    rest_.remove_prefix(result.size());
    return result;
  }

  double number() {
    const auto text = word();
    double value = 0;
    const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), value);
    if (error != std::errc() || end != text.data() + text.size() || !std::isfinite(value))
      fail(fmt::format("'{}'", text), "a number");
    return value;
  }

  [[noreturn]] void fail(std::string_view found, std::string_view allowed) const {
    throw InputError(describe({name_, line_, ""}, found, allowed));
  }

  size_t position() const { return at_; }

 private:
  std::string_view text_, rest_;
  const std::string& name_;
  size_t at_ = 0;
  int line_ = 0;
};

std::vector<double> parse_axis(Words& words, std::string_view name) {
  words.begin_line();
  const auto found = words.word();
  if (found != name) words.fail(fmt::format("'{}'", found), fmt::format("'{}'", name));
  const double size = words.number();
  if (!(size >= 1 && size <= 1000 && size == std::floor(size))) {
    words.fail(fmt::format("{}", size), "1 to 1000 values");
  }
  std::vector<double> axis(static_cast<size_t>(size));
  for (double& value : axis) value = words.number();
  return axis;
}

GaitNode parse_node(Words& words) {
  words.begin_line();
  GaitNode node;
  node.cyclic = words.number() != 0;
  node.valid = words.number() != 0;
  for (double* value : {&node.cost_of_transport, &node.clearance, &node.swing_flexion,
                        &node.stance_flexion, &node.multiplier})
    *value = words.number();
  for (double& value : node.gait.reshaped()) value = words.number();
  for (double& value : node.gain.reshaped()) value = words.number();
  return node;
}

void write_axis(std::string& text, std::string_view name, const std::vector<double>& axis) {
  auto out = std::back_inserter(text);
  fmt::format_to(out, "{} {}", name, axis.size());
  for (const double value : axis) fmt::format_to(out, " {:.10g}", value);
  text += '\n';
}

}  // namespace

std::string gait_prior_text(const GaitPrior& prior, std::string_view tool_version) {
  std::string text = fmt::format("{}\nwritten by walktrack {}\n", kVersionLine, tool_version);
  write_axis(text, "speeds", prior.speeds);
  write_axis(text, "ratios", prior.ratios);
  write_axis(text, "slopes", prior.slopes);
  auto out = std::back_inserter(text);
  for (const GaitNode& n : prior.nodes) {
    fmt::format_to(out, "{:d} {:d} {:.6g} {:.5g} {:.5g} {:.5g} {:.5g}", n.cyclic, n.valid,
                   n.cost_of_transport, n.clearance, n.swing_flexion, n.stance_flexion,
                   n.multiplier);
    for (const double value : n.gait.reshaped()) fmt::format_to(out, " {:.11g}", value);
    for (const double value : n.gain.reshaped()) fmt::format_to(out, " {:.4g}", value);
    text += '\n';
  }
  return text + fmt::format("checksum {:016x}\n", checksum(text));
}

GaitPrior parse_gait_prior(std::string_view text, const std::string& name) {
  Words words(text, name);
  const auto version = words.line();
  if (version != kVersionLine)
    words.fail(fmt::format("'{}'", version), fmt::format("'{}'", kVersionLine));
  words.line();
  GaitPrior prior;
  prior.speeds = parse_axis(words, "speeds");
  prior.ratios = parse_axis(words, "ratios");
  prior.slopes = parse_axis(words, "slopes");
  const size_t size = prior.speeds.size() * prior.ratios.size() * prior.slopes.size();
  if (size > text.size()) words.fail(fmt::format("{} nodes", size), "a line for each node");
  prior.nodes.reserve(size);
  for (size_t i = 0; i < size; ++i) prior.nodes.push_back(parse_node(words));
  const std::string expected =
      fmt::format("checksum {:016x}", checksum(text.substr(0, words.position())));
  const auto found = words.line();
  if (found != expected) words.fail(fmt::format("'{}'", found), fmt::format("'{}'", expected));
  return prior;
}

GaitPrior load_gait_prior() {
  return parse_gait_prior(shipped_gait_prior_text(), "gait prior of this program");
}

}  // namespace walktrack
