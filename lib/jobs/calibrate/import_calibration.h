// `walktrack calibrate --import`: converts cameras that another tool has calibrated. It writes into
// a folder <name>.yaml (OpenCV, for scenes) for every camera, and cameras.toml (Pose2Sim) and
// cameras_run.json (the origin) for all of them; for a single camera <name>.yaml, <name>.toml and
// <name>_run.json. Axes stay those of the file.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "io/calibration/calibration.h"

namespace walktrack {
inline namespace jobs {

struct ImportJob {
  std::filesystem::path file;
  std::string name{};               // the only camera to convert; empty: all cameras
  std::optional<ImageSize> size{};  // of the images, for files that do not state it
  std::filesystem::path output;
  bool overwrite = false;
  std::vector<std::string> command_line;
};

struct ImportOutcome {
  std::vector<std::pair<std::string, Camera>> cameras;
  std::vector<std::string> notes;  // notes for the user
};

// InputError for a file that cannot be parsed, and for cameras whose names are not valid file
// names.
ImportOutcome import_calibration(const ImportJob& job);

// A description of the outcome.
std::string import_text(const ImportOutcome& outcome);

}  // namespace jobs
}  // namespace walktrack
