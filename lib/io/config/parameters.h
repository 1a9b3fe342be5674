// A table that states, for every parameter of the program, its key, its member, what is allowed and
// what it means. The configuration file, --set, error messages and `walktrack config` all use this
// table; defaults are those of the structs.
//
//   ParameterGroup<FilterConfig> f(table, "filter", "the particle filter", &Config::tracker,
//                                  &TrackerConfig::filter);
//   f.integer("particles", &FilterConfig::particles, 1, 10'000'000, "number of particles");
//   f.number("layer_ess", &FilterConfig::layer_ess, 0, 1, "effective share of the particles ...");
#pragma once

#include <array>
#include <cstdint>
#include <functional>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

namespace walktrack {
inline namespace io {

struct Config;

struct Parameter {
  std::string key;      // dotted, e.g. "filter.particles"
  std::string allowed;  // for messages, e.g. "a whole number from 1 to 10000000"
  std::string comment;  // one line, with the unit
  // Sets the value from text; returns false if the text is not allowed.
  std::function<bool(Config&, const std::string& text)> set;
  std::function<std::string(const Config&)> get;
};

struct ParameterTable {
  std::vector<Parameter> parameters;
  std::vector<std::pair<std::string, std::string>> groups;  // prefix, description
};

// Converts text to a value and back, with a range; the description of what is allowed is used in
// messages.
bool number_in_range(const std::string& text, double lowest, double highest, double& value);
bool integer_in_range(const std::string& text, int64_t lowest, int64_t highest, int64_t& value);
bool flag_from_text(const std::string& text, bool& value);
std::string number_allowed(double lowest, double highest);
std::string integer_allowed(int64_t lowest, int64_t highest);
std::string number_text(double value);
// A list "[a, b, c]" of `count` numbers, which must be integers if `whole` is set.
bool list_in_range(const std::string& text, size_t count, bool whole, double lowest, double highest,
                   std::vector<double>& values);
std::string list_allowed(size_t count, bool whole, double lowest, double highest);
std::string list_text(const std::vector<double>& values);

// Adds the parameters of one struct, which is a member of Config through a chain of members.
template <typename Group>
class ParameterGroup {
 public:
  // `members` leads from Config to the Group: none (Group = Config), &Config::filter, or
  // &Config::observation, &ObservationConfig::flow, and so on.
  template <typename... Members>
  ParameterGroup(ParameterTable& table, std::string prefix, std::string about, Members... members)
      : table_(table),
        prefix_(std::move(prefix)),
        reach_([members...](Config& config) -> Group& { return follow(config, members...); }) {
    if (!about.empty()) table_.groups.emplace_back(prefix_, std::move(about));
  }

  void number(const std::string& name, double Group::*member, double lowest, double highest,
              std::string comment) {
    add(
        name, number_allowed(lowest, highest), std::move(comment),
        [=](Group& group, const std::string& text) {
          return number_in_range(text, lowest, highest, group.*member);
        },
        [=](const Group& group) { return number_text(group.*member); });
  }

  template <typename Integer>
  void integer(const std::string& name, Integer Group::*member, int64_t lowest, int64_t highest,
               std::string comment) {
    add(
        name, integer_allowed(lowest, highest), std::move(comment),
        [=](Group& group, const std::string& text) {
          int64_t value = 0;
          if (!integer_in_range(text, lowest, highest, value)) return false;
          group.*member = static_cast<Integer>(value);
          return true;
        },
        [=](const Group& group) { return std::to_string(group.*member); });
  }

  // A list of as many numbers as the array holds.
  template <typename Number, size_t N>
  void list(const std::string& name, std::array<Number, N> Group::*member, double lowest,
            double highest, std::string comment) {
    add(
        name, list_allowed(N, std::is_integral_v<Number>, lowest, highest), std::move(comment),
        [=](Group& group, const std::string& text) {
          std::vector<double> values;
          if (!list_in_range(text, N, std::is_integral_v<Number>, lowest, highest, values)) {
            return false;
          }
          for (size_t i = 0; i < N; ++i) (group.*member)[i] = static_cast<Number>(values[i]);
          return true;
        },
        [=](const Group& group) {
          const auto& values = group.*member;
          return list_text({values.begin(), values.end()});
        });
  }

  void flag(const std::string& name, bool Group::*member, std::string comment) {
    add(
        name, "true or false", std::move(comment),
        [=](Group& group, const std::string& text) { return flag_from_text(text, group.*member); },
        [=](const Group& group) { return std::string(group.*member ? "true" : "false"); });
  }

  // Any text of one line that is not empty.
  void text(const std::string& name, std::string Group::*member, std::string comment) {
    add(
        name, "a text", std::move(comment),
        [=](Group& group, const std::string& value) {
          if (value.empty() || value.find('\n') != std::string::npos) return false;
          group.*member = value;
          return true;
        },
        [=](const Group& group) { return group.*member; });
  }

  template <typename Enum>
  void choice(const std::string& name, Enum Group::*member,
              std::vector<std::pair<std::string, Enum>> values, std::string comment) {
    std::string allowed;
    for (const auto& [word, value] : values) allowed += (allowed.empty() ? "" : ", ") + word;
    add(
        name, allowed, std::move(comment),
        [=](Group& group, const std::string& text) {
          for (const auto& [word, value] : values) {
            if (word != text) continue;
            group.*member = value;
            return true;
          }
          return false;
        },
        [=](const Group& group) {
          for (const auto& [word, value] : values) {
            if (value == group.*member) return word;
          }
          return std::string();
        });
  }

  // auto, on or off; the words of a flag are allowed as well.
  template <typename Enum>
  void setting(const std::string& name, Enum Group::*member, std::string comment) {
    choice(name, member,
           {{"auto", Enum::kAuto},
            {"on", Enum::kOn},
            {"off", Enum::kOff},
            {"true", Enum::kOn},
            {"false", Enum::kOff}},
           std::move(comment));
  }

 private:
  template <typename Outer>
  static Outer& follow(Outer& outer) {
    return outer;
  }
  template <typename Outer, typename Member, typename... Rest>
  static Group& follow(Outer& outer, Member member, Rest... rest) {
    return follow(outer.*member, rest...);
  }

  template <typename Set, typename Get>
  void add(const std::string& name, std::string allowed, std::string comment, Set set, Get get) {
    table_.parameters.push_back({prefix_.empty() ? name : prefix_ + "." + name, std::move(allowed),
                                 std::move(comment),
                                 [reach = reach_, set](Config& config, const std::string& text) {
                                   return set(reach(config), text);
                                 },
                                 // `reach` only selects members; it does not write.
                                 [reach = reach_, get](const Config& config) {
                                   return get(reach(const_cast<Config&>(config)));
                                 }});
  }

  ParameterTable& table_;
  std::string prefix_;
  std::function<Group&(Config&)> reach_;
};

}  // namespace io
}  // namespace walktrack
