// Reads a TRC file (Motion Analysis; OpenSim): two lines of names and values, the points' names
// over three columns each, their axes, then one row for each frame; cells are separated by tabs.
// Empty cells and "nan" are unknown.
#pragma once

#include <string>
#include <string_view>

#include "io/tables/marker_table.h"

namespace walktrack {
inline namespace io {

// Throws an InputError with place, found and allowed; `file` is its name in messages.
MarkerTable markers_from_trc(std::string_view text, const std::string& file);

}  // namespace io
}  // namespace walktrack
