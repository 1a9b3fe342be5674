// Tables of gaits as text: a version line, the axes, one line for each node, and a checksum.
#pragma once

#include <string>
#include <string_view>

#include "gait/prior/gait_prior.h"
#include "gait/prior/straight_prior.h"

namespace walktrack {
inline namespace gait {

std::string gait_prior_text(const GaitPrior& prior, std::string_view tool_version);
std::string straight_prior_text(const StraightPrior& prior, std::string_view tool_version);

// `name` is used in messages. InputError for another version, a wrong checksum or invalid numbers.
GaitPrior parse_gait_prior(std::string_view text, const std::string& name);
StraightPrior parse_straight_prior(std::string_view text, const std::string& name);

// The texts of the shipped tables, compiled into the program.
std::string_view shipped_gait_prior_text();
std::string_view shipped_straight_prior_text();

}  // namespace gait
}  // namespace walktrack
