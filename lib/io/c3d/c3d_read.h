// The points of a C3D file (C3D User Guide, c3d.org): little-endian, numbers or floats.
#pragma once

#include <string>
#include <string_view>

#include "io/tables/marker_table.h"

namespace walktrack {
inline namespace io {

// InputError with place, found and allowed; `file` is what messages call it.
MarkerTable markers_from_c3d(std::string_view bytes, const std::string& file);

}  // namespace io
}  // namespace walktrack
