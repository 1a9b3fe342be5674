// The intervals in which a gait's feet are on the ground.
#pragma once

#include <vector>

#include "kinetics/ground_contact.h"
#include "metrics/gait.h"

namespace walktrack {
inline namespace kinetics {

// The stances as contacts. If an end of the motion cuts a stance while the other foot's event shows
// double support, its duration is taken from the rest of the motion, or is 0.12 s (a walk at 1.3
// m/s) if there is none.
std::vector<FootContact> foot_contacts(const Gait& gait);

}  // namespace kinetics
}  // namespace walktrack
