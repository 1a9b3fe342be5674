// Walks that do not begin where the scene says.
#pragma once

#include <optional>
#include <string>

#include "body/motion.h"
#include "io/scene/scene.h"

namespace walktrack {
inline namespace jobs {

// A note for the result if the tracked subject is elsewhere, or nobody was tracked, at the time for
// which the scene states a place.
std::optional<std::string> stated_start_note(const Motion& motion, const InitialState& stated);

}  // namespace jobs
}  // namespace walktrack
