// Keys of the configuration as they were called in the release before this one. They are still
// read; ConfigWithOrigin::renamed says so.
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
