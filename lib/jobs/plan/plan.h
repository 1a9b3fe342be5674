// `walktrack plan`: states what tracking a scene would model and why, what it would cost, and what
// the scene does not need. It tracks nothing: the costs are those of cost_model.h.
#pragma once

#include <filesystem>
#include <string>
#include <utility>
#include <vector>

#include "io/config/config.h"
#include "io/scene/scene.h"
#include "jobs/plan/cost_model.h"
#include "jobs/plan/plan_levels.h"

namespace walktrack {
inline namespace jobs {

struct PlanItem {
  std::string name;
  bool on = true;
  std::string what;  // description
  std::string why;   // the reason why it is on or off: a default, the configuration, the scene
  double ms = 0;     // CPU time for each frame; 0 if it is off
};

struct PlanCamera {
  std::string name;
  int width_px = 0, height_px = 0, shrink = 1;
  double person_px = 0;  // height of the standing subject in the shrunk image
  double ms = 0;         // all costs of this camera
};

struct Plan {
  std::filesystem::path scene;  // its file
  double frame_rate = 0;
  std::vector<PlanCamera> cameras;
  std::vector<PlanItem> items;
  PlanState state;
  PlanLevels levels;
  FrameWork work;
  FrameCost cost;
  std::vector<std::pair<std::string, double>> memory;  // purpose, bytes
  std::vector<std::string> advice;                     // on what the scene does not need
};

// Opens the scene's videos, but reads no frame. Throws an InputError whenever `track` would.
Plan plan_scene(const Scene& scene, const ConfigWithOrigin& config);

}  // namespace jobs
}  // namespace walktrack
