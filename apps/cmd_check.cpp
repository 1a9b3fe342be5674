// walktrack check: tests of scenes and calibrations.
#include <fmt/format.h>

#include "commands.h"
#include "jobs/check/check.h"
#include "terminal.h"

namespace walktrack {

int run_check(const Arguments& arguments) {
  CheckJob job;
  std::string scene;
  bool json = false;
  CommandLine line(
      {.name = "check",
       .operands = "SCENE.yaml",
       .about =
           "Says where each camera stands and what it sees, and finds mistakes in calibrations "
           "and\nvideos with their cure. With -o FOLDER it draws ground, axes and a standing "
           "figure into a\nframe of each camera. The exit code is 3 if something is wrong.",
       .example = "walktrack check data/demo/scene.yaml -o out/check"});
  line.options().add_options()("json", boost::program_options::bool_switch(&json), "print JSON");
  line.operand("SCENE.yaml", &scene);
  if (!line.parse(arguments)) return kDone;
  job.scene = scene;
  job.pictures = line.common().output;
  Terminal terminal(line.common());
  const CheckReport report = check_scene(job, terminal.control());
  fmt::print("{}", json ? check_json(report) : check_text(report));
  return report.failed() ? kUnreadable : kDone;
}

}  // namespace walktrack
