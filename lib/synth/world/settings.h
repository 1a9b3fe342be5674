// Predefined surroundings: a furnished room, a field with trees, a studio with an empty floor.
#pragma once

#include <cstdint>

#include <Eigen/Core>

#include "synth/world/world.h"

namespace walktrack {
inline namespace synth {

enum class Setting { kRoom, kField, kStudio };

// The surroundings of a walk whose path is within `reach` metres of `centre`.
World make_world(Setting setting, const Eigen::Vector2d& centre, double reach, const Light& light,
                 uint64_t seed);

}  // namespace synth
}  // namespace walktrack
