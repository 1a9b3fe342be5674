// walktrack: the table of commands, and the conversion of errors to exit codes.
#include <algorithm>
#include <array>
#include <cstdio>
#include <cstdlib>
#include <exception>
#include <string>
#include <string_view>
#include <vector>

#include <fmt/format.h>

#include "commands.h"
#include "core/errors.h"
#include "core/version.h"
#include "manual.h"
#include "progress_pace.h"
#include "terminal.h"

namespace walktrack {
namespace {

constexpr std::array kCommands{
    Command{"analyse", "gait, angles and forces of a motion, tracked or measured", run_analyse},
    Command{"batch", "track every scene below a folder, resumable", run_batch},
    Command{"calibrate", "find the lens and the place of a camera", run_calibrate},
    Command{"check", "find mistakes in a scene, its calibrations and videos", run_check},
    Command{"compare", "compare results: before and after, left and right", run_compare},
    Command{"config", "print all parameters with comments: defaults or effective values",
            run_config},
    Command{"cycle", "find a limit cycle of a walker and compute its properties", run_cycle},
    Command{"evaluate", "measure estimates against a truth", run_evaluate},
    Command{"init", "make a scene from a video and the subject's height", run_init},
    Command{"optimise", "clean the track of another tool: body, floor, video", run_optimise},
    Command{"plan", "say what tracking would model, why, and what it costs", run_plan},
    Command{"prior", "build or show the table of gaits", run_prior},
    Command{"render", "render a motion as a synthetic video with its truth", run_render},
    Command{"selftest", "run this program on extreme inputs and report each outcome", run_selftest},
    Command{"simulate", "simulate a walker; write tables, pictures and an animation", run_simulate},
    Command{"sweep", "measure what accuracy costs: error against speed", run_sweep},
    Command{"track", "track the subject of one scene", run_track},
};

void print_overview() {
  fmt::print(
      "walktrack - tracks a walking person in calibrated video with a physical gait model\n\n"
      "usage: walktrack COMMAND [OPTIONS]\n\nCommands:\n");
  for (const Command& command : kCommands) {
    fmt::print("  {:<10} {}\n", command.name, command.summary);
  }
  fmt::print(
      "\n  --version  version and build\n"
      "  --help     this text; 'walktrack COMMAND --help' explains a command\n\n"
      "{}\nExample:\n  walktrack config\n",
      kExitCodes);
}

void print_version() {
  const BuildFacts& facts = build_facts();
  fmt::print("walktrack {}\ncommit {}\nbuilt {} by {}\n", facts.version, facts.commit,
             facts.build_type, facts.compiler);
}

int run_command(std::string_view name, const Arguments& arguments) {
  std::vector<std::string> names;
  for (const Command& command : kCommands) {
    if (command.name == name) {
      watch_signals();
      const int code = command.run(arguments);
      return stop_request() ? kInterrupted : code;
    }
    names.emplace_back(command.name);
  }
  const std::string nearest = nearest_word(name, names);
  throw UsageError(
      fmt::format("unknown command '{}'{}; see 'walktrack --help'", name,
                  nearest.empty() ? "" : fmt::format(", did you mean '{}'?", nearest)));
}

int run(const Arguments& words) {
  if (words.size() == 2 && words[0] == "help") return run_command(words[1], {"--help"});
  if (words.empty() || words[0] == "--help" || words[0] == "-h" || words[0] == "help") {
    print_overview();
    return kDone;
  }
  if (words[0] == kManualRequest) {
    print_manual(kCommands);
    return kDone;
  }
  if (words[0] == kWordsRequest) {
    for (const Command& command : kCommands) fmt::print("{}\n", command.name);
    fmt::print("--help\n--version\n");
    return kDone;
  }
  if (words[0] == "--version") {
    print_version();
    return kDone;
  }
  return run_command(words[0], {words.begin() + 1, words.end()});
}

// Whether the arguments ask for errors as JSON, also if they are not a valid command line.
bool has_option(const Arguments& words, std::string_view option, std::string_view value = "") {
  for (size_t i = 0; i < words.size(); ++i) {
    if (value.empty() && words[i] == option) return true;
    if (!value.empty() && words[i] == fmt::format("{}={}", option, value)) return true;
    if (!value.empty() && words[i] == option && i + 1 < words.size() && words[i + 1] == value)
      return true;
  }
  return false;
}

int complain(const Arguments& words, const std::exception& error, ExitCode code) {
  // fmt::print would throw if stderr is a file on a full disk.
  std::fputs(has_option(words, "--progress", "json")
                 ? error_json(error.what(), code).c_str()
                 : fmt::format("walktrack: {}\n", error.what()).c_str(),
             stderr);
  if (has_option(words, "--json-line"))
    std::fputs(failed_result_json(words.empty() ? "" : words[0], error.what(), code).c_str(),
               stdout);
  return code;
}

}  // namespace
}  // namespace walktrack

int main(int argc, char** argv) {
  using namespace walktrack;
  // Decoders write messages of their own to stderr; those of this program name file and frame.
  setenv("OPENCV_FFMPEG_LOGLEVEL", "-8", 0);
  setenv("OPENCV_LOG_LEVEL", "SILENT", 0);
  const Arguments words(argv + std::min(argc, 1), argv + argc);
  try {
    return run(words);
  } catch (const UsageError& error) {
    return complain(words, error, kUsage);
  } catch (const InputError& error) {
    return complain(words, error, kUnreadable);
  } catch (const std::exception& error) {
    return complain(words, error, kFailed);
  }
}
