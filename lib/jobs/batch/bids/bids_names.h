// Data sets laid out as BIDS (https://bids-specification.readthedocs.io): names of files made of
// entities, "sub-01_ses-2_task-walk_run-1_video.mp4", in a folder for each subject.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "jobs/batch/batch_sequences.h"

namespace walktrack {
inline namespace jobs {

struct BidsName {
  std::vector<std::pair<std::string, std::string>> entities;  // {"sub", "01"}, ..., as in the name
  std::string suffix;                                         // "video"

  std::optional<std::string> label(std::string_view entity) const;
};

// Parses a name without its extension; nullopt if it does not consist of entities, beginning with
// sub, and a suffix. Labels are letters and digits.
std::optional<BidsName> bids_name(std::string_view stem);

// "sub-01_ses-2_task-walk_run-1"
std::string entities_text(const BidsName& name);

// The entities of a derived file, "sub-01_ses-2_task-walk_tracksys-walktrack_run-1_desc-tracked",
// in the order of Motion-BIDS. desc is needed because a derived file must not have the name of a
// recorded one.
std::string tracked_entities_text(const BidsName& name);

inline constexpr const char* kTrackingSystem = "walktrack";  // label of tracksys

// "sub-01/ses-2/motion"
std::filesystem::path motion_folder(const BidsName& name);

// The videos of a data set: files below its sub-<label> folders with the suffix "video", in natural
// order and with names such as "results/sub-01_ses-2_task-walk_run-1". InputError for a video
// without a task, in another subject's folder, or with the name of another one.
std::vector<Sequence> find_bids_videos(const std::filesystem::path& folder,
                                       const std::filesystem::path& output);

}  // namespace jobs
}  // namespace walktrack
