// The table of all parameters: key, member, range and meaning, one line each. To add a parameter,
// add its member with a default to the module's config struct and its line to config_table.cpp.
#pragma once

#include "io/config/config.h"
#include "io/config/parameters.h"

namespace walktrack {
inline namespace io {

const ParameterTable& config_table();

}  // namespace io
}  // namespace walktrack
