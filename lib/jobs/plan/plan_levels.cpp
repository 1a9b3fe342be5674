#include "jobs/plan/plan_levels.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "core/conventions.h"
#include "gait/step_map.h"
#include "tracker/walker_filter.h"

namespace walktrack {
inline namespace jobs {

namespace {

// Within these angles a walk is seen from the side: the distance to the camera changes by less than
// 3 m in 7, and a lateral displacement of a foot is seen at no more than a quarter of its size.
constexpr double kSideOn = 65, kLevel = 15;  // degrees

BodyModel model_of(const Scene& scene, const Config& config) {
  BodyModel model;
  model.body = make_body(scene.subject, config.body);
  model.path = config.tracker.motion.path;
  return model;
}

// The reason why one camera does not see this walk from the side; empty if it does.
std::string not_from_the_side(const Scene& scene) {
  if (scene.cameras.size() > 1) return "several cameras see turning and step width";
  const auto view = side_view(scene, scene.cameras[0].camera);
  if (!view) {
    const double down = deg_from_rad(std::asin(-scene.cameras[0].camera.rotation(2, 2)));
    return std::abs(down) > kLevel ? fmt::format("the camera looks {:.0f} degrees {}",
                                                 std::abs(down), down > 0 ? "down" : "up")
                                   : "";
  }
  const double off = deg_from_rad(view->off_sight), below = deg_from_rad(view->below_horizon);
  if (off < kSideOn)
    return fmt::format("the walk goes {:.0f} degrees off the camera's line of sight", off);
  if (std::abs(below) > kLevel)
    return fmt::format("the camera sees the subject from {:.0f} degrees above the horizon", below);
  return "";
}

PlanLevel level_of(const std::string& name, const std::vector<std::string>& settings,
                   const Scene& scene, const ConfigWithOrigin& config) {
  ConfigWithOrigin changed = config;
  for (const std::string& setting : settings) apply_setting(changed, setting, "");
  PlanLevel level{name, settings, state_of(scene, changed.values)};
  level.on = changed.values.tracker.motion.path == config.values.tracker.motion.path &&
             changed.values.body.arms == config.values.body.arms;
  return level;
}

}  // namespace

PlanState state_of(const Scene& scene, const Config& config) {
  const BodyModel model = model_of(scene, config);
  const auto free = static_cast<int>(free_residuals(model).size());
  PlanState state;
  state.walker = static_cast<int>(KneedState{}.q.size() + KneedState{}.qd.size());
  // The position of the supporting foot, and the velocity of the root or the constant heading.
  state.place = 2 + (turns(model) ? 2 : 1);
  state.pose = 2 * free;              // values of two frames, from which rates follow
  state.controls = kControlSize + 2;  // four springs with dampers and rest angles, a push-off; the
                                      // target of the step
  state.noise = kResidualNoise + free;
  // Two copies of each state, three weights, a parent index and flags.
  state.bytes_per_particle = 2.0 * sizeof(WalkerParticle) + 6.0 * sizeof(double);
  return state;
}

PlanLevels plan_levels(const Scene& scene, const ConfigWithOrigin& config) {
  PlanLevels out;
  const auto add = [&](const std::string& name, const std::vector<std::string>& settings) {
    out.levels.push_back(level_of(name, settings, scene, config));
  };
  add("sagittal path", {"motion.path=sagittal", "body.arms=false"});
  add("spatial path", {"motion.path=spatial", "body.arms=false"});
  add("+ arms", {"body.arms=true"});
  const std::string more = not_from_the_side(scene);
  out.levels[more.empty() ? 0 : 1].lowest = true;
  if (!more.empty()) {
    out.why = more;
  } else if (scene.initial) {
    out.why = "one camera sees the walk from the side";
  } else {
    out.why =
        "one level camera sees a walk straight across its picture from the side; no `initial` says "
        "that this\n  one comes closer, goes away or turns, which would need the spatial path";
  }
  return out;
}

std::optional<SideView> side_view(const Scene& scene, const Camera& camera) {
  if (!scene.initial) return std::nullopt;
  const Eigen::Vector3d eye = camera_centre(camera);
  const Eigen::Vector2d sight = scene.initial->position - eye.head<2>();
  const Eigen::Vector2d way(std::cos(scene.initial->heading), std::sin(scene.initial->heading));
  return SideView{std::acos(std::min(1.0, std::abs(sight.normalized().dot(way)))),
                  std::atan2(eye.z() - 0.5 * scene.subject.height, sight.norm())};
}

}  // namespace jobs
}  // namespace walktrack
