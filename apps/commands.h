// The commands, one apps/cmd_<name>.cpp each. main.cpp lists them with their summaries.
#pragma once

#include "command.h"

namespace walktrack {

int run_config(const Arguments& arguments);

}  // namespace walktrack
