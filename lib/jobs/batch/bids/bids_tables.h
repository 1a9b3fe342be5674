// A result in the form of Motion-BIDS (BEP029, since BIDS 1.9; Jeung et al., Scientific Data 11,
// 2024):
//   motion.tsv     a row a frame without a header: joint positions in m, joint angles in degrees
//   channels.tsv   what its columns are; channels.json says what they refer to
//   motion.json    rate, counts, what it was made of
//   events.tsv     foot strikes and toe-offs, s from the first frame; events.json says what they
//   are
// Unknown values are "n/a".
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "io/tables/csv.h"

namespace walktrack {
inline namespace jobs {

struct BidsFile {
  std::string name;  // after the entities: "motion.tsv"
  std::string content;
};

// What is said of a result beside what it holds.
struct BidsOrigin {
  std::string task;    // as in the video's name
  std::string source;  // a BIDS URI of the video
  std::string system;  // label of tracksys
};

// Of a complete result folder. InputError for tables that cannot be read.
std::vector<BidsFile> bids_files(const std::filesystem::path& result, const BidsOrigin& origin);

// The names of all of these.
std::vector<std::string> bids_file_names();

// dataset_description.json of what is derived from the data set `folder` (its name is taken from
// its own dataset_description.json, if it has one) and lies in `output`.
std::string bids_description(const std::filesystem::path& folder,
                             const std::filesystem::path& output);

}  // namespace jobs
}  // namespace walktrack
