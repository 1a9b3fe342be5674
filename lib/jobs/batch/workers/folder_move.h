// Moves a whole folder so that it appears in its place by one rename, also from another file
// system.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace walktrack {
inline namespace jobs {

// Moves the folder `from` to `to`, where there is nothing or an empty folder. If `to` is on another
// file system, the files are copied into a new folder inside `stage` (a folder on that file system)
// and flushed; then that folder is renamed and `from` is removed. `alive` is called after every
// megabyte. If `to` contains other files, the new files are moved one by one, with `last` as the
// last one, because it marks the folder as complete. Links are not followed: std::runtime_error for
// anything that is neither a file nor a folder, and for errors of the system, with the file and the
// reason.
void move_folder(const std::filesystem::path& from, const std::filesystem::path& to,
                 const std::filesystem::path& stage, const std::string& last,
                 const std::function<void()>& alive = {});

}  // namespace jobs
}  // namespace walktrack
