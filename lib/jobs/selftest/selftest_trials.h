// The trials of `walktrack selftest`: each renders a video, tracks it and judges the result.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace walktrack {
inline namespace jobs {

enum class TrialEnd { kTracked, kDegraded, kReported, kFailed };

inline constexpr double kTrackedWithin = 0.17;  // of the height, median of the pelvis

struct TrialResult {
  std::string name{};
  TrialEnd end = TrialEnd::kFailed;
  std::string what{};      // errors, or the reason
  double seconds = 0;      // wall time of its process
  double peak_memory = 0;  // of its process, MB; 0 = unknown
};

// In the order of the table; `stress` adds the long ones.
std::vector<std::string> trial_names(bool stress);

// Runs one trial in this process; videos and results are written to `folder`, which is created.
// UsageError for an unknown name and for a folder that is not empty; other exceptions than errors
// for the user are passed on.
TrialResult run_trial(const std::string& name, const std::filesystem::path& folder);

}  // namespace jobs
}  // namespace walktrack
