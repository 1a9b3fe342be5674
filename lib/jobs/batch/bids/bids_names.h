// Data sets laid out as BIDS (https://bids-specification.readthedocs.io): names of files made of
// entities, "sub-01_ses-2_task-walk_run-1_video.mp4", in a folder for each subject.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "jobs/batch/batch.h"

namespace walktrack {
inline namespace jobs {

struct BidsName {
  std::vector<std::pair<std::string, std::string>> entities;  // {"sub", "01"}, ..., as in the name
  std::string suffix;                                         // "video"

  std::optional<std::string> label(std::string_view entity) const;
};

// Of a name without its ending; nullopt for one that is not made of entities, beginning with sub,
// and a suffix. Labels are letters and digits.
std::optional<BidsName> bids_name(std::string_view stem);

// "sub-01_ses-2_task-walk_run-1"
std::string entities_text(const BidsName& name);

// The same, of what was tracked in it: "sub-01_ses-2_task-walk_tracksys-walktrack_run-1_
// desc-tracked", as Motion-BIDS orders entities. A file that was derived has to have another name
// than any that may be recorded: hence desc.
std::string tracked_entities_text(const BidsName& name);

inline constexpr const char* kTrackingSystem = "walktrack";  // the label of tracksys

// "sub-01/ses-2/motion"
std::filesystem::path motion_folder(const BidsName& name);

// The videos of a data set, those below its sub-<label> folders whose suffix is "video"; in natural
// order, named "results/sub-01_ses-2_task-walk_run-1". InputError for a video without a task, in
// another subject's folder, or of another one's name.
std::vector<Sequence> find_bids_videos(const std::filesystem::path& folder,
                                       const std::filesystem::path& output);

}  // namespace jobs
}  // namespace walktrack
