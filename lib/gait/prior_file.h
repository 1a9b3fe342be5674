// The gait prior as text: a version line, the axes, one line a node, and a checksum of all that.
#pragma once

#include <string>
#include <string_view>

#include "gait/gait_prior.h"

namespace walktrack {

std::string gait_prior_text(const GaitPrior& prior, std::string_view tool_version);

// `name` stands in messages. Throws InputError on another version, a wrong checksum or bad numbers.
GaitPrior parse_gait_prior(std::string_view text, const std::string& name);

// The text of the shipped table, compiled into the program.
std::string_view shipped_gait_prior_text();

}  // namespace walktrack
