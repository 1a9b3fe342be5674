// Checks of a checkpoint or of a frame's record beyond those that io/archive/archive.h makes for
// each field: lists of equal length, images of their stated size, living particles with finite
// numbers.
#pragma once

#include <string_view>

#include "io/archive/checkpoint_file.h"
#include "tracker/walker_filter.h"

namespace walktrack {
inline namespace io {

// The error in words; "" if there is none.
std::string_view trouble_of(const ObserverState& state);
std::string_view trouble_of(const TrackerState& state);
std::string_view trouble_of(const FrameRecord& record);
std::string_view trouble_of(const Checkpoint& checkpoint);

}  // namespace io
}  // namespace walktrack
