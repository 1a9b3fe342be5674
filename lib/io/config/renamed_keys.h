// Keys of the configuration that have been renamed since the last release. The old names are still
// read, and are listed in ConfigWithOrigin::renamed.
#pragma once

#include <span>
#include <string_view>

namespace walktrack {
inline namespace io {

struct RenamedKey {
  std::string_view before, now;
};
std::span<const RenamedKey> renamed_keys();

}  // namespace io
}  // namespace walktrack
