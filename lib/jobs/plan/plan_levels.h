// The levels of the model, each of which includes the one before, and the lowest level that a scene
// needs:
//
//   sagittal path  legs and trunk in upright planes of one heading, for a side view of one camera;
//                  without an `initial` a level camera is taken to see one
//   spatial path   turning, pelvic obliquity, hips sideways: for everything else
//   arms           on the path that is set; legs, pelvis and trunk are tracked without them
//
// A slope is the scene's own (its gravity), and costs a walker of their own for all particles.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "io/config/config.h"
#include "io/scene/scene.h"

namespace walktrack {
inline namespace jobs {

struct PlanState {
  int walker = 0, place = 0, pose = 0, controls = 0;  // numbers in a particle
  int noise = 0;                                      // random numbers for it in each frame
  double bytes_per_particle = 0;                      // all copies and weights of the filter
  int dimension() const { return walker + place + pose + controls; }
};

PlanState state_of(const Scene& scene, const Config& config);

struct PlanLevel {
  std::string name;
  std::vector<std::string> settings;  // settings for --set
  PlanState state;
  bool on = false;      // the level of the configuration
  bool lowest = false;  // the lowest one that suffices
};

struct PlanLevels {
  std::vector<PlanLevel> levels;  // from the lowest up
  std::string why;                // the reason why the lowest one suffices
};

PlanLevels plan_levels(const Scene& scene, const ConfigWithOrigin& config);

// According to the scene's `initial`: the angle between the walk and a camera's line of sight over
// the ground, 0 to pi/2 rad, and the angle of the subject's middle below the horizon.
struct SideView {
  double off_sight = 0, below_horizon = 0;  // rad
};
std::optional<SideView> side_view(const Scene& scene, const Camera& camera);

}  // namespace jobs
}  // namespace walktrack
