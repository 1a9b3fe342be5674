// The named configurations that come with the program: configs/*.yaml of the source tree.
#pragma once

#include <span>
#include <string_view>

namespace walktrack {
inline namespace io {

struct Preset {
  std::string_view name, yaml;
};

// In the order from fast to accurate.
std::span<const Preset> presets();

}  // namespace io
}  // namespace walktrack
