// Subjects who walk towards their only camera or away from it: the images say little about how far
// away they are.
#pragma once

#include <optional>
#include <string>

#include "body/motion.h"
#include "camera/camera.h"

namespace walktrack {
inline namespace jobs {

// The share of the pelvis' way over the ground, in steps of a second, that is along the viewing
// rays of a camera at that place; 0 if it does not move.
double share_along_rays(const Motion& motion, const Eigen::Vector2d& camera);

// A note for the result if the subject walks rather along the camera's rays than across them.
std::optional<std::string> viewing_ray_note(const Motion& motion, const Camera& camera);

}  // namespace jobs
}  // namespace walktrack
