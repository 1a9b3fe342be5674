// When a gait's feet are on the ground.
#pragma once

#include <vector>

#include "kinetics/ground_contact.h"
#include "metrics/gait.h"

namespace walktrack {
inline namespace kinetics {

// The stances as contacts. A stance that an end of the motion cuts, while the other foot's event
// shows that both stood, is taken to share the ground as long as feet did elsewhere in the motion,
// or 0.12 s (a walk at 1.3 m/s) if nowhere.
std::vector<FootContact> foot_contacts(const Gait& gait);

}  // namespace kinetics
}  // namespace walktrack
