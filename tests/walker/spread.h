// A random number for the tests of batches of walkers.
#pragma once

#include "core/rng.h"

namespace walktrack {

// From -size to size, every number as likely.
inline double spread(Rng& rng, double size) { return size * (2 * rng.uniform() - 1); }

}  // namespace walktrack
