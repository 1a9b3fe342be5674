// walktrack render: converts a motion to a synthetic scene with its truth.
#include <chrono>

#include <fmt/format.h>

#include "commands.h"
#include "core/errors.h"
#include "io/scene/render_file.h"
#include "io/tables/motion_file.h"
#include "jobs/render/render.h"
#include "terminal.h"

namespace walktrack {

namespace po = boost::program_options;

int run_render(const Arguments& arguments) {
  std::string motion, options;
  CommandLine line(
      {.name = "render",
       .operands = "[MOTION.csv]",
       .about = "Renders a motion (joints.csv, or a result folder of 'walktrack track'; without "
                "MOTION.csv the\n'walk' or 'gait' of the options) as a calibrated video with its "
                "truth. The result is a scene\nfolder that 'walktrack track' reads.",
       .example = "walktrack render data/demo/truth.csv -o out/again"});
  line.options().add_options()("options", po::value(&options)->value_name("FILE"),
                               "what to render and how (YAML): cameras, light, clothes, ...");
  line.operand("MOTION.csv", &motion, /*optional=*/true);
  if (!line.parse(arguments)) return kDone;
  RenderJob job;
  job.output = line.required_output();
  if (!options.empty()) {
    RenderFile file = read_render_file(options);
    job.options = std::move(file.options);
    job.walker = std::move(file.subject);
    job.gait = std::move(file.gait);
    job.inputs = std::move(file.motions);
  }
  if (!motion.empty()) {
    job.gait.reset();
    const std::filesystem::path given = motion;
    const bool is_result = std::filesystem::is_directory(given);
    job.inputs.push_back(is_result ? given / "joints.csv" : given);
    job.walker.motion = read_motion(job.inputs.back());
  } else if (job.walker.motion.time.empty() && !job.gait) {
    throw UsageError(
        "nothing to render: name a MOTION.csv, or a 'walk' or 'gait' in the --options");
  }
  const Config config = line.config().values;
  if (!line.common().seed.empty()) job.options.seed = config.seed;
  job.threads = config.threads;
  job.overwrite = line.common().overwrite;
  Terminal terminal(line.common());
  const auto start = std::chrono::steady_clock::now();
  const size_t frames = render_scene(job, terminal.control());
  const std::chrono::duration<double> time = std::chrono::steady_clock::now() - start;
  if (line.common().verbose)
    fmt::print(stderr, "walktrack: {} frames in {:.1f} s\n", frames, time.count());
  return kDone;
}

}  // namespace walktrack
