// walktrack plan: models and cost of tracking a scene.
#include <fmt/format.h>

#include "commands.h"
#include "jobs/plan/plan.h"
#include "jobs/plan/plan_text.h"

namespace walktrack {

int run_plan(const Arguments& arguments) {
  std::string file;
  bool json = false;
  CommandLine line({.name = "plan",
                    .operands = "SCENE.yaml",
                    .about = "Says what tracking this scene would model and why, how large a "
                             "particle's state is, what a\nframe is expected to cost in time and "
                             "memory, and what could be left out. It tracks nothing.",
                    .example = "walktrack plan data/demo/scene.yaml"});
  line.options().add_options()("json", boost::program_options::bool_switch(&json), "print JSON");
  line.operand("SCENE.yaml", &file);
  if (!line.parse(arguments)) return kDone;
  const ConfigWithOrigin config = line.config();
  const Scene scene = read_scene(file);
  const Plan plan = plan_scene(scene, config);
  line.write_or_print(json ? plan_json(plan) : plan_text(plan), files_of(scene));
  return kDone;
}

}  // namespace walktrack
