// The sequences of a batch: how they are found, and the state of their result folders.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

#include "jobs/batch/batch_figures.h"

namespace walktrack {
inline namespace jobs {

struct Sequence {
  std::string name;  // path below the folder, e.g. "monday/trial3"
  std::filesystem::path scene, output;
  std::filesystem::path video{};  // the video for which `scene` is yet to be made of a template
};

inline constexpr const char* kFailureFile = "failure.txt";  // the reason why there is no result

enum class SequenceState { kWaiting, kComplete, kDegraded, kFailed };

struct SequenceResult {
  SequenceState state = SequenceState::kWaiting;
  std::string reason{};                       // of the failure, or of the quality check that failed
  double seconds = 0;                         // duration of tracking; 0 = unknown
  double cpu_seconds = 0, video_seconds = 0;  // CPU time and duration of the tracked video; 0 =
                                              // unknown
  std::string digest{};
  BatchFigures figures{};
};

// All files scene*.yaml below the folder, and other .yaml files that list cameras, in natural order
// of their names, except for those in `output`. Links to folders are not followed.
std::vector<Sequence> find_sequences(const std::filesystem::path& folder,
                                     const std::filesystem::path& output);

// All video files below the folder, except for those in `output`.
std::vector<std::filesystem::path> videos_below(const std::filesystem::path& folder,
                                                const std::filesystem::path& output);

// The same as sequences; their scenes will be OUT/<sequence>/scene.yaml.
std::vector<Sequence> find_videos(const std::filesystem::path& folder,
                                  const std::filesystem::path& output);

// The sequence's name according to its scene's path below the folder: "a/b/scene.yaml" is "a/b";
// other files keep their stem.
std::string sequence_name(const std::filesystem::path& relative);

// The state of OUT/<sequence>/.
SequenceResult result_of(const Sequence& sequence);

std::string_view state_name(SequenceState state);

}  // namespace jobs
}  // namespace walktrack
