// The moment at which somebody who stands starts to walk. Of a hundred particles that stand one or
// two set off in a frame (tracker/motion/standing.h), with either leg; for the first third of a
// second the images hardly show which of them are right, and those are gone when it shows. So the
// frames from several moments before it are tracked again with particles that all set off at once.
// tracker/reports/standing.md has measurements.
#pragma once

#include "tracker/start/attempt.h"

namespace walktrack {
inline namespace tracker {

// The attempt, or one with another moment of setting off that explains the window better. One in
// which nobody sets off is unchanged.
Attempt with_best_set_off(const WindowFrames& window, Attempt attempt);

}  // namespace tracker
}  // namespace walktrack
