// An output folder that says by itself whether it is complete: it holds run.json only when every
// other file is there. Interrupted or failed work leaves run.partial.json instead.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <string_view>

namespace walktrack {

bool is_complete_result(const std::filesystem::path& folder);

class ResultFolder {
 public:
  // Makes the folder. UsageError if it holds a complete result and may not be overwritten, or is a
  // file. What an earlier run left (its run.json first) is removed but for `kept`; other files are
  // not touched.
  ResultFolder(const std::filesystem::path& folder, bool overwrite,
               std::span<const std::string_view> kept = {});

  const std::filesystem::path& path() const { return folder_; }
  // Where a file of the result goes.
  std::filesystem::path file(const std::string& name) const { return folder_ / name; }
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
};

}  // namespace walktrack
