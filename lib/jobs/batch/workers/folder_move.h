// Moves a whole folder so that it appears in its place by one rename, also from another file
// system.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace walktrack {
inline namespace jobs {

// Moves the folder `from` to `to`, where nothing or an empty folder is. On another file system its
// files are copied into a new folder inside `stage` (a folder on that of `to`) and flushed, then
// that folder is renamed and `from` removed; `alive` is called after every megabyte. Where `to`
// holds other files its own take their places one by one, `last` as the last: it tells who looks
// that all are there. Links are not followed: std::runtime_error for what is neither file nor
// folder, and naming the file and the reason where the system refuses.
void move_folder(const std::filesystem::path& from, const std::filesystem::path& to,
                 const std::filesystem::path& stage, const std::string& last,
                 const std::function<void()>& alive = {});

}  // namespace jobs
}  // namespace walktrack
