// The folder that a command writes into. Everything in it belongs to the user, except for the files
// that are listed by a marker of the program: .walktrack_<command> is written before anything else
// and names all files that the command may write there, one per line. The marker shows which files
// a killed run has left; nothing else is ever replaced or removed. Names that begin with
// .walktrack_ are reserved.
//
// A folder is complete if its last file exists, which is run.json for most commands. Interrupted or
// failed work leaves run.partial.json instead.
#pragma once

#include <filesystem>
#include <set>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace walktrack {
inline namespace io {

inline constexpr const char* kRunFile = "run.json";

// A hidden folder of the program beside another one: this prefix and the other's name.
inline constexpr const char* kHiddenFolder = ".walktrack_for.";

// What a command is about to write into a folder.
struct Outputs {
  std::filesystem::path folder;
  std::string command;                          // that writes the marker, e.g. "track"
  std::vector<std::string> files;               // all files that may be written; see
                                                // numbered_files()
  std::vector<std::filesystem::path> inputs{};  // files that the command reads; none may be in the
                                                // folder
  std::string last = kRunFile;                  // the file that makes the result complete; "" =
                                                // none does
};

// Stands for many file names <folder>/<beginning><number><ending>, e.g. "labels/side" and ".png".
// Nothing else is written into that folder.
std::string numbered_files(const std::string& folder, const std::string& ending,
                           const std::string& beginning = "");

// Throws a UsageError with advice if the folder is a file, or contains an input, a scene that is
// not the command's own, or a file with one of the names that no marker of the command lists; and
// for names that are not file names or appear twice. Changes nothing.
void refuse_what_is_not_ours(const Outputs& outputs);

// Throws a UsageError if `file` is one of the inputs, which would be overwritten.
void refuse_input(const std::filesystem::path& file,
                  const std::vector<std::filesystem::path>& inputs);

bool is_complete_result(const std::filesystem::path& folder);

// Removes the files that the command's marker lists, the last file first, and then the marker.
void remove_marked(const std::filesystem::path& folder, const std::string& command);

class ResultFolder {
 public:
  // Refuses a folder with other files, and a complete result that may not be overwritten
  // (UsageError). Creates the folder, removes what an earlier run of the command has left there
  // except for `kept`, and writes the marker.
  ResultFolder(const Outputs& outputs, bool overwrite, std::span<const std::string_view> kept = {});

  const std::filesystem::path& path() const { return folder_; }
  // The path of a file of the result. Throws std::logic_error for a name that is not among the
  // outputs.
  std::filesystem::path file(const std::string& name) const;
  // Writes a whole file, which appears complete or not at all.
  void write(const std::string& name, std::string_view content) const;
  // Removes files that are only needed during the work.
  void remove(std::span<const std::string_view> names) const;

  // Writes the last file of a complete result.
  void finish(std::string_view run_json) const;
  // Writes the last file of an incomplete result that is kept.
  void finish_partial(std::string_view run_json) const;

 private:
  std::filesystem::path folder_;
  std::set<std::string> files_;
};

}  // namespace io
}  // namespace walktrack
