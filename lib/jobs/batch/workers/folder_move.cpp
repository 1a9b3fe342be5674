#include "jobs/batch/workers/folder_move.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <stdexcept>
#include <string>
#include <system_error>
#include <vector>

#include <fmt/format.h>

#include "io/archive/files.h"

namespace walktrack {
inline namespace jobs {

namespace fs = std::filesystem;

namespace {

constexpr size_t kBlockBytes = size_t{1} << 20;

[[noreturn]] void fail_moving(const fs::path& path, int error) {
  throw std::runtime_error(fmt::format("{}: cannot be moved: {}", path.string(),
                                       std::generic_category().message(error)));
}

// Returns 0 or the error number.
int renamed(const fs::path& from, const fs::path& to) {
  return ::rename(from.c_str(), to.c_str()) == 0 ? 0 : errno;
}

void copy_file(const fs::path& from, const fs::path& to, const std::function<void()>& alive) {
  std::ifstream in(from, std::ios::binary);
  if (!in) fail_moving(from, errno);
  AtomicFile out(to);
  std::string block(kBlockBytes, '\0');
  while (in.read(block.data(), static_cast<std::streamsize>(block.size())) || in.gcount() > 0) {
    out.write(std::string_view(block).substr(0, static_cast<size_t>(in.gcount())));
    if (alive) alive();
  }
  if (in.bad()) fail_moving(from, EIO);
  out.commit();
}

void copy_folder(const fs::path& from, const fs::path& to, const std::function<void()>& alive) {
  for (const auto& entry : fs::directory_iterator(from)) {
    const fs::path place = to / entry.path().filename();
    const fs::file_status status = entry.symlink_status();
    if (fs::is_directory(status)) {
      fs::create_directory(place);
      copy_folder(entry.path(), place, alive);
    } else if (fs::is_regular_file(status)) {
      copy_file(entry.path(), place, alive);
    } else {
      fail_moving(entry.path(), EINVAL);
    }
  }
}

// A new folder is readable only for its owner; results get the permissions of any other folder.
void open_to_others(const fs::path& folder) {
  const mode_t mask = ::umask(0);
  ::umask(mask);
  fs::permissions(folder, static_cast<fs::perms>(0777U & ~mask));
}

// Moves the files into a folder that others can see already; the file that marks it complete is
// moved last.
void merge(const fs::path& from, const fs::path& to, const std::string& last) {
  std::vector<fs::path> names;
  for (const auto& entry : fs::directory_iterator(from))
    if (entry.path().filename() != last) names.push_back(entry.path().filename());
  if (!last.empty() && fs::exists(from / last)) names.emplace_back(last);
  for (const fs::path& name : names) {
    if (fs::is_directory(fs::symlink_status(from / name)) &&
        fs::is_directory(fs::symlink_status(to / name))) {
      merge(from / name, to / name, "");
      continue;
    }
    const int error = renamed(from / name, to / name);
    if (error != 0) fail_moving(to / name, error);
  }
  fs::remove(from);
}

// Moves what is on the same file system as `to`.
void put_in_place(const fs::path& from, const fs::path& to, const std::string& last) {
  const int error = renamed(from, to);
  if (error == ENOTEMPTY || error == EEXIST) return merge(from, to, last);
  if (error != 0) fail_moving(to, error);
}

bool on_one_file_system(const fs::path& a, const fs::path& b) {
  struct stat one {
  }, other{};
  if (::stat(a.c_str(), &one) != 0) fail_moving(a, errno);
  if (::stat(b.c_str(), &other) != 0) fail_moving(b, errno);
  return one.st_dev == other.st_dev;
}

}  // namespace

void move_folder(const fs::path& from, const fs::path& to, const fs::path& stage,
                 const std::string& last, const std::function<void()>& alive) {
  // Two mounts of one file system refuse a rename as well, so that `stage` is used in either case.
  const fs::path moved = new_folder(stage / "new.");
  if (!on_one_file_system(from, stage) || renamed(from, moved) != 0) {
    copy_folder(from, moved, alive);
    open_to_others(moved);
    put_in_place(moved, to, last);
    fs::remove_all(from);
    return;
  }
  put_in_place(moved, to, last);
}

}  // namespace jobs
}  // namespace walktrack
