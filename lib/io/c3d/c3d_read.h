// Reads the points of a C3D file (C3D User Guide, c3d.org) with little-endian integers or floats.
#pragma once

#include <string>
#include <string_view>

#include "io/tables/marker_table.h"

namespace walktrack {
inline namespace io {

// Throws an InputError with place, found and allowed; `file` is its name in messages.
MarkerTable markers_from_c3d(std::string_view bytes, const std::string& file);

}  // namespace io
}  // namespace walktrack
