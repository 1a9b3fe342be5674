#include "io/archive/origin.h"

#include <algorithm>
#include <map>

#include <fmt/format.h>

namespace walktrack {
inline namespace io {

namespace {

constexpr size_t kMostNamed = 4;

using Values = std::map<std::string, std::string>;

const std::string* find(const Values& values, const std::string& key) {
  const auto found = values.find(key);
  return found == values.end() ? nullptr : &found->second;
}

std::string in_words(const std::string& key, const std::string* found, const std::string* wanted) {
  if (key.starts_with(kContentOf)) {
    const std::string file = key.substr(std::string(kContentOf).size());
    return file + (!found ? " is new" : !wanted ? " is not read any more" : " has changed");
  }
  return fmt::format("{} {} -> {}", key, found ? *found : "not known",
                     wanted ? *wanted : "not known");
}

}  // namespace

std::string differences(const Origin& found, const Origin& wanted) {
  const Values before(found.begin(), found.end()), now(wanted.begin(), wanted.end());
  Origin all = wanted;
  std::ranges::copy_if(found, std::back_inserter(all),
                       [&](const auto& pair) { return !now.contains(pair.first); });
  std::vector<std::string> words;
  for (const auto& [key, value] : all) {
    const std::string *a = find(before, key), *b = find(now, key);
    if (!a || !b || *a != *b) words.push_back(in_words(key, a, b));
  }
  std::string text;
  for (size_t i = 0; i < std::min(words.size(), kMostNamed); ++i)
    text += (i > 0 ? ", " : "") + words[i];
  if (words.size() > kMostNamed) text += fmt::format(" and {} more", words.size() - kMostNamed);
  return text;
}

}  // namespace io
}  // namespace walktrack
