// walktrack init: makes a scene from one or two videos and a height.
#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "commands.h"
#include "core/conventions.h"
#include "core/errors.h"
#include "io/scene/subject_file.h"
#include "jobs/init/init.h"
#include "jobs/init/init_pair.h"
#include "terminal.h"

namespace walktrack {

namespace po = boost::program_options;

namespace {

// U1,V1,U2,V2,METRES
FloorLength floor_length(const std::string& text) {
  std::vector<double> numbers;
  std::stringstream parts(text);
  for (std::string part; std::getline(parts, part, ',');)
    numbers.push_back(number_from_text(part).value_or(kUnknown));
  const auto sound = [](double number) { return std::isfinite(number); };
  if (numbers.size() != 5 || !std::all_of(numbers.begin(), numbers.end(), sound) ||
      numbers[4] < 0.05 || numbers[4] > 100 ||
      std::hypot(numbers[2] - numbers[0], numbers[3] - numbers[1]) < 4)
    throw UsageError(
        fmt::format("--floor: found '{}', allowed: U1,V1,U2,V2,METRES, two points of the picture "
                    "at least 4 px apart and their distance on the floor, 0.05 to 100",
                    text));
  return {{numbers[0], numbers[1]}, {numbers[2], numbers[3]}, numbers[4]};
}

struct InitOptions {
  std::string video, second;
  std::vector<std::string> backgrounds, floor;
  std::vector<double> fovs;
  double height = 0, mass = 0, tilt = 0, rate = 0;
};

void declare(CommandLine& line, InitOptions& options) {
  auto add = line.options().add_options();
  add("height", po::value(&options.height)->value_name("M"),
      "height of the subject, with the shoes worn in the video");
  add("mass", po::value(&options.mass)->value_name("KG"), "mass of the subject");
  add("background", po::value(&options.backgrounds)->composing()->value_name("PATH"),
      "video or images of the empty scene; default: learned from the video. For two videos this "
      "option is given twice");
  add("fov-deg", po::value(&options.fovs)->composing()->value_name("DEG"),
      "field of view along the longer side of the picture; default: that of the lens or the "
      "telephone that the file names, otherwise 64. For two videos once for both cameras, or "
      "twice");
  add("tilt-deg", po::value(&options.tilt)->value_name("DEG"),
      "measured angle by which the camera looks down; default: 0, with a standard deviation of 3 "
      "degrees");
  add("floor", po::value(&options.floor)->composing()->value_name("U1,V1,U2,V2,M"),
      "two points on the floor in the picture, px, and the distance between them, m: sides and "
      "diagonals of a tile, one --floor each");
  add("frame-rate", po::value(&options.rate)->value_name("HZ"), "frame rate of images");
  line.operand("VIDEO", &options.video);
  line.operand("VIDEO", &options.second, true);
}

double subject_height(const CommandLine& line, double height) {
  const auto tall = line.within("height", height, 0.5, 2.5);
  if (!tall) throw UsageError("--height is missing: the height of the subject in metres");
  return *tall;
}

// Sets the options that both kinds of jobs share.
void set_common(auto& job, const CommandLine& line, const InitOptions& options,
                const Arguments& arguments) {
  job.height = subject_height(line, options.height);
  job.mass = line.within("mass", options.mass, kSmallestMass, kGreatestMass);
  job.frame_rate = line.within("frame-rate", options.rate, 0.1, 1000);
  job.output = line.required_output();
  job.overwrite = line.common().overwrite;
  job.command_line = {"walktrack", "init"};
  job.command_line.insert(job.command_line.end(), arguments.begin(), arguments.end());
}

// The n-th value of an option that is given once for all videos or once for each.
std::optional<double> field_of_view(const CommandLine& line, const InitOptions& options, size_t n) {
  if (options.fovs.empty()) return std::nullopt;
  return line.within("fov-deg", options.fovs[std::min(n, options.fovs.size() - 1)], 5, 150);
}

void check_count(const char* option, size_t found, const char* allowed, bool fine) {
  if (!fine)
    throw UsageError(fmt::format("--{}: found {} values, allowed: {}", option, found, allowed));
}

int ended(const CommandLine& line, Terminal& terminal, const std::string& text,
          const std::filesystem::path& scene, const CheckReport& check) {
  if (!line.common().quiet) fmt::print("{}", text);
  terminal.control().say(fmt::format("next: walktrack track {}", scene.string()));
  return check.failed() ? kUnreadable : kDone;
}

int run_one(const CommandLine& line, const InitOptions& options, const Arguments& arguments) {
  check_count("fov-deg", options.fovs.size(), "one", options.fovs.size() <= 1);
  check_count("background", options.backgrounds.size(), "one", options.backgrounds.size() <= 1);
  InitJob job;
  job.video = options.video;
  if (!options.backgrounds.empty()) job.background = options.backgrounds[0];
  job.fov_deg = field_of_view(line, options, 0);
  job.tilt_deg = line.within("tilt-deg", options.tilt, -45, 45);
  for (const std::string& length : options.floor) job.floor.push_back(floor_length(length));
  job.threads = line.config().values.threads;
  set_common(job, line, options, arguments);
  Terminal terminal(line.common());
  const InitOutcome outcome = init_scene(job, terminal.control());
  return ended(line, terminal, init_text(outcome), outcome.scene, outcome.check);
}

int run_pair(const CommandLine& line, const InitOptions& options, const Arguments& arguments) {
  line.refuse({"tilt-deg", "floor"},
              "this option with one video; for two videos the walk determines it");
  check_count("fov-deg", options.fovs.size(), "one or two", options.fovs.size() <= 2);
  check_count("background", options.backgrounds.size(), "none or two, one for each video",
              options.backgrounds.empty() || options.backgrounds.size() == 2);
  InitPairJob job;
  job.videos = {options.video, options.second};
  job.backgrounds.assign(options.backgrounds.begin(), options.backgrounds.end());
  job.fov_deg = {field_of_view(line, options, 0), field_of_view(line, options, 1)};
  set_common(job, line, options, arguments);
  Terminal terminal(line.common());
  const InitPairOutcome outcome = init_pair(job, terminal.control());
  return ended(line, terminal, init_pair_text(outcome), outcome.scene, outcome.check);
}

}  // namespace

int run_init(const Arguments& arguments) {
  CommandLine line(
      {.name = "init",
       .operands = "VIDEO [VIDEO]",
       .about = "Makes a scene that can be tracked from a video and the subject's height, without "
                "a calibration.\nOne camera has to stand still and nearly level and see the whole "
                "subject walk past from the side;\nor two cameras (telephones) that stand still "
                "see one walk at the same time from two sides.\nWrites scene.yaml, the cameras and "
                "a picture to check into the folder --output, prints how exact\nthe result is "
                "(with bands), and checks the scene. The exit code is 3 if something is wrong.",
       .example = "walktrack init data/demo/side.mp4 --height 1.75 --background "
                  "data/demo/side_background.mp4 -o out/init"});
  InitOptions options;
  declare(line, options);
  if (!line.parse(arguments)) return kDone;
  return options.second.empty() ? run_one(line, options, arguments)
                                : run_pair(line, options, arguments);
}

}  // namespace walktrack
