// What a result depends on: the program, the configuration and the content of the inputs, each with
// a name, so that messages can state how two results differ.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace walktrack {
inline namespace io {

// {"version of the program", "1.0 ..."}, {"filter.particles", "120"},
// {"content of side.mp4", "9f86d0..."}, ...
using Origin = std::vector<std::pair<std::string, std::string>>;

inline constexpr const char* kContentOf = "content of ";

// What differs in `wanted` from `found`: "filter.particles 120 -> 60, side.mp4 has changed"; "" if
// nothing does. Long lists end in "and 12 more".
std::string differences(const Origin& found, const Origin& wanted);

}  // namespace io
}  // namespace walktrack
