// walktrack init: from a video and a height to a scene.
#include <fmt/format.h>

#include "commands.h"
#include "core/errors.h"
#include "jobs/init/init.h"
#include "terminal.h"

namespace walktrack {

namespace po = boost::program_options;

namespace {

std::optional<double> within(const CommandLine& line, const char* option, double value, double low,
                             double high) {
  if (!line.given(option)) return std::nullopt;
  if (!(value >= low && value <= high))
    throw UsageError(
        fmt::format("--{}: found {:g}, allowed: {:g} to {:g}", option, value, low, high));
  return value;
}

}  // namespace

int run_init(const Arguments& arguments) {
  std::string video, background;
  double height = 0, mass = 0, fov = 0, tilt = 0, rate = 0;
  CommandLine line(
      {.name = "init",
       .operands = "VIDEO",
       .about =
           "Makes a scene that can be tracked of a video and the subject's height, without a "
           "calibration:\nsomebody walks past one camera that stands still and nearly level, "
           "seen whole and from the side.\nWrites scene.yaml, camera.yaml and a picture to check "
           "into the folder --output, says with bands\nwhat they may be used for, and checks "
           "the scene. Exits with 3 if something is wrong.",
       .example = "walktrack init data/demo/side.mp4 --height 1.75 --background "
                  "data/demo/side_background.mp4 -o out/init"});
  auto add = line.options().add_options();
  add("height", po::value(&height)->value_name("M"), "of the subject, with shoes as filmed");
  add("mass", po::value(&mass)->value_name("KG"), "of the subject");
  add("background", po::value(&background)->value_name("PATH"),
      "video or images of the empty scene; default: learned from the video");
  add("fov-deg", po::value(&fov)->value_name("DEG"),
      "field of view along the longer side of the picture; default: of the file's lens, else 64");
  add("tilt-deg", po::value(&tilt)->value_name("DEG"),
      "how far the camera looks down, measured; default: level, with 3 degrees of doubt");
  add("frame-rate", po::value(&rate)->value_name("HZ"), "of images");
  line.operand("VIDEO", &video);
  if (!line.parse(arguments)) return kDone;
  InitJob job;
  job.video = video;
  job.background = background;
  const auto tall = within(line, "height", height, 0.5, 2.5);
  if (!tall) throw UsageError("--height is missing: the subject's, in metres");
  job.height = *tall;
  job.mass = within(line, "mass", mass, 0.5, 1000);
  job.fov_deg = within(line, "fov-deg", fov, 5, 150);
  job.tilt_deg = within(line, "tilt-deg", tilt, -45, 45);
  job.frame_rate = within(line, "frame-rate", rate, 0.1, 1000);
  job.threads = line.config().values.threads;
  job.output = line.required_output();
  job.overwrite = line.common().overwrite;
  job.command_line = {"walktrack", "init"};
  job.command_line.insert(job.command_line.end(), arguments.begin(), arguments.end());
  Terminal terminal(line.common());
  const InitOutcome outcome = init_scene(job, terminal.control());
  if (!line.common().quiet) fmt::print("{}", init_text(outcome));
  terminal.control().say(fmt::format("next: walktrack track {}", outcome.scene.string()));
  return outcome.check.failed() ? kUnreadable : kDone;
}

}  // namespace walktrack
