// Random numbers of the body's tests.
#pragma once

#include "core/rng.h"

namespace walktrack {

// Uniform between -limit and limit.
inline double draw(Rng& rng, double limit) { return limit * (2 * rng.uniform() - 1); }

}  // namespace walktrack
