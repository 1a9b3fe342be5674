// What the numbers of a checkpoint or a frame's record have to be for the tracker to go on from
// them, beyond what io/archive/archive.h sees in each field by itself: lists of one length, images
// of their stated size, living particles made of finite numbers.
#pragma once

#include <string_view>

#include "io/archive/checkpoint_file.h"
#include "tracker/walker_filter.h"

namespace walktrack {
inline namespace io {

// What is wrong, in words; "" = nothing.
std::string_view trouble_of(const ObserverState& state);
std::string_view trouble_of(const TrackerState& state);
std::string_view trouble_of(const FrameRecord& record);
std::string_view trouble_of(const Checkpoint& checkpoint);

}  // namespace io
}  // namespace walktrack
