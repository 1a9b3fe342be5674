// A result in the form of Motion-BIDS (BEP029, since BIDS 1.9; Jeung et al., Scientific Data 11,
// 2024):
//   motion.tsv     one row for each frame, without a header: joint positions in m, joint angles in
//                  degrees
//   channels.tsv   a description of its columns, with their reference frames in channels.json
//   motion.json    rate, counts, origin
//   events.tsv     foot strikes and toe-offs, s from the first frame, described in events.json
// Unknown values are "n/a".
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/tables/csv.h"

namespace walktrack {
inline namespace jobs {

struct BidsFile {
  std::string name;  // the part after the entities: "motion.tsv"
  std::string content;
};

// Statements about a result that its folder does not contain.
struct BidsOrigin {
  std::string task;    // as in the video's name
  std::string source;  // BIDS URI of the video
  std::string system;  // label of tracksys
};

// The files for a complete result folder. InputError for tables that cannot be read.
std::vector<BidsFile> bids_files(const std::filesystem::path& result, const BidsOrigin& origin);

// The names of all of these.
std::vector<std::string> bids_file_names();

// The content of dataset_description.json for a derivative in `output` of the data set `folder`
// (with its name according to its own dataset_description.json if it has one).
std::string bids_description(const std::filesystem::path& folder,
                             const std::filesystem::path& output);

}  // namespace jobs
}  // namespace walktrack
