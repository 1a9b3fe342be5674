// `walktrack calibrate --import`: cameras that another tool has calibrated, as files for scenes.
// Into a folder, for every camera <name>.yaml (OpenCV, as scenes use it), then for all of them
// cameras.toml (Pose2Sim) and cameras_run.json: how the files came about; of a file with one
// camera, or where one is asked for, <name>.yaml, <name>.toml and <name>_run.json. Axes stay the
// file's own.
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
  std::string name{};               // the one camera to take; empty: all of the file's
  std::optional<ImageSize> size{};  // of the images, for files that do not say
  std::filesystem::path output;
  bool overwrite = false;
  std::vector<std::string> command_line;
};

struct ImportOutcome {
  std::vector<std::pair<std::string, Camera>> cameras;
  std::vector<std::string> notes;  // what the user should know
};

// InputError for a file that is not understood, and for names in it that files cannot have.
ImportOutcome import_calibration(const ImportJob& job);

// The outcome for people.
std::string import_text(const ImportOutcome& outcome);

}  // namespace jobs
}  // namespace walktrack
