#include "io/archive/result_folder.h"

#include <algorithm>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/archive/files.h"

namespace walktrack {

namespace fs = std::filesystem;

namespace {

constexpr const char* kComplete = "run.json";
constexpr const char* kPartial = "run.partial.json";

// The files that a run may leave, besides the two above; those that it was killed over, too.
bool is_result_file(const std::string& name) {
  if (is_temporary_name(name)) return true;
  for (const char* known :
       {"joints.csv", "joints.trc", "angles.mot", "uncertainty.csv", "angles.csv", "gait.json",
        "gait.csv", "kinetics.csv", "tables.json", "ground_reaction.mot", "joint_moments.sto",
        "report.html", "checkpoint.bin", "frames.bin", "smoothed_frames.bin"}) {
    if (name == known) return true;
  }
  return name.starts_with("overlay_") && name.ends_with(".mp4");
}

}  // namespace

bool is_complete_result(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_regular_file(folder / kComplete, ignored);
}

ResultFolder::ResultFolder(const fs::path& folder, bool overwrite,
                           std::span<const std::string_view> kept)
    : folder_(folder) {
  if (fs::exists(folder) && !fs::is_directory(folder)) {
    throw UsageError(
        fmt::format("{} is a file, allowed: a folder for the results", folder.string()));
  }
  if (is_complete_result(folder) && !overwrite) {
    throw UsageError(fmt::format("{} holds a complete result; -y overwrites it", folder.string()));
  }
  fs::create_directories(folder);
  fs::remove(folder / kComplete);
  fs::remove(folder / kPartial);
  for (const auto& entry : fs::directory_iterator(folder)) {
    const std::string name = entry.path().filename().string();
    if (is_result_file(name) && std::ranges::find(kept, name) == kept.end())
      fs::remove(entry.path());
  }
}

void ResultFolder::remove(std::span<const std::string_view> names) const {
  for (const std::string_view name : names) fs::remove(folder_ / name);
}

void ResultFolder::write(const std::string& name, std::string_view content) const {
  write_file_atomically(file(name), content);
}

void ResultFolder::finish(std::string_view run_json) const { write(kComplete, run_json); }

void ResultFolder::finish_partial(std::string_view run_json) const { write(kPartial, run_json); }

}  // namespace walktrack
