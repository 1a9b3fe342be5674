// The folder that a command writes into. Whatever it holds is the user's, but for the files that a
// marker of ours lists: .walktrack_<command>, written before anything else, with the names of all
// files that the command may write there, one a line. So what a killed run has left is known, and
// nothing else is ever replaced or removed. Names that begin with .walktrack_ are ours.
//
// A folder says by itself whether it is complete: the last file, run.json of most commands, is
// there only when every other file is. Interrupted or failed work leaves run.partial.json instead.
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

// A folder of ours beside another one and for it: this and the other's name.
inline constexpr const char* kHiddenFolder = ".walktrack_for.";

// What a command is about to do to a folder.
struct Outputs {
  std::filesystem::path folder;
  std::string command;                          // whose marker it is, e.g. "track"
  std::vector<std::string> files;               // all that may be written; see numbered_files()
  std::vector<std::filesystem::path> inputs{};  // what the command reads; none may be in the folder
  std::string last = kRunFile;                  // makes the work complete; "" = it never is
};

// In the place of a name: <folder>/<beginning><number><ending>, e.g. "labels/side" and ".png". The
// folder then holds nothing else.
std::string numbered_files(const std::string& folder, const std::string& ending,
                           const std::string& beginning = "");

// UsageError, which says what to do, for a folder that is a file, holds an input, a scene that is
// not the command's own, or a file of one of the names that no marker of the command lists; and for
// names that are no file names or there twice. Changes nothing.
void refuse_what_is_not_ours(const Outputs& outputs);

// UsageError when `file` is one of the inputs, which would be overwritten.
void refuse_input(const std::filesystem::path& file,
                  const std::vector<std::filesystem::path>& inputs);

bool is_complete_result(const std::filesystem::path& folder);

// Removes the files that the command's marker lists, and the marker; the last file first.
void remove_marked(const std::filesystem::path& folder, const std::string& command);

class ResultFolder {
 public:
  // Refuses what is not ours, and what is complete and may not be overwritten (UsageError); makes
  // the folder, removes what the command's earlier run left there (the last file first) but for
  // `kept`, and marks it.
  ResultFolder(const Outputs& outputs, bool overwrite, std::span<const std::string_view> kept = {});

  const std::filesystem::path& path() const { return folder_; }
  // Where a file of the result goes. std::logic_error for one that the outputs do not name.
  std::filesystem::path file(const std::string& name) const;
  // Writes a whole file; it appears complete or not at all.
  void write(const std::string& name, std::string_view content) const;
  // Removes files of the work itself, before the result is complete without them.
  void remove(std::span<const std::string_view> names) const;

  // The last file of a complete result.
  void finish(std::string_view run_json) const;
  // The last file of a result that is kept but not complete.
  void finish_partial(std::string_view run_json) const;

 private:
  std::filesystem::path folder_;
  std::set<std::string> files_;
};

}  // namespace io
}  // namespace walktrack
