#include "jobs/batch/manifest.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <functional>
#include <map>
#include <stdexcept>
#include <system_error>
#include <utility>

#include <fmt/format.h>

#include "core/errors.h"
#include "jobs/batch/batch_sequences.h"

namespace walktrack {
inline namespace jobs {

namespace fs = std::filesystem;

namespace {

constexpr size_t kManifestBlock = size_t{1} << 16;
constexpr size_t kLongestLine = size_t{1} << 14;  // bytes
constexpr size_t kLongestPart = 200;              // of a name, bytes, as for the files of a result

std::string trouble_of_system() { return std::generic_category().message(errno); }

// Copies the manifest to a temporary file: a pipe can be read only once, but rows are read several
// times.
int copied(int from) {
  std::string name = (fs::temp_directory_path() / "walktrack_manifestXXXXXX").string();
  const int to = ::mkstemp(name.data());
  if (to < 0) throw std::runtime_error(fmt::format("{}: {}", name, trouble_of_system()));
  ::unlink(name.c_str());
  std::array<char, kManifestBlock> block;
  for (ssize_t got; (got = ::read(from, block.data(), block.size())) != 0;) {
    if (got < 0 && errno == EINTR) continue;
    if (got < 0 || ::write(to, block.data(), static_cast<size_t>(got)) != got)
      throw std::runtime_error(fmt::format("the manifest: {}", trouble_of_system()));
  }
  return to;
}

int opened(const std::string& path, const std::string& file) {
  const int fd = path == "-" ? ::dup(STDIN_FILENO) : ::open(path.c_str(), O_RDONLY | O_CLOEXEC);
  struct stat facts {};
  if (fd < 0 || ::fstat(fd, &facts) != 0)
    throw InputError(fmt::format("{}: cannot be read: {}", file, trouble_of_system()));
  if (S_ISDIR(facts.st_mode)) {
    ::close(fd);
    throw InputError(describe({file, 0, ""}, "a folder", "a list of scenes, one a line"));
  }
  if (S_ISREG(facts.st_mode) && path != "-") return fd;
  const int copy = copied(fd);
  ::close(fd);
  return copy;
}

// The reason why it cannot be the name of a result folder; "" if it can.
std::string trouble_of_name(std::string_view name) {
  if (std::ranges::any_of(name, [](char c) { return static_cast<unsigned char>(c) < 0x20; }))
    return "a control character";
  while (true) {
    const size_t slash = name.find('/');
    const std::string_view part = name.substr(0, slash);
    if (part.empty()) return "an empty part";
    if (part[0] == '.') return "a part with a leading dot";
    if (part.size() > kLongestPart) return "a part of more than 200 bytes";
    if (slash == std::string_view::npos) return "";
    name.remove_prefix(slash + 1);
  }
}

}  // namespace

Manifest::Manifest(const std::string& path, bool videos)
    : file_(path == "-" ? "standard input" : path),
      folder_(path == "-" ? fs::current_path()
                          : fs::absolute(path).lexically_normal().parent_path()),
      videos_(videos),
      fd_(opened(path, file_)) {
  try {
    look_through();
  } catch (...) {
    ::close(fd_);  // the destructor does not run after an exception in the constructor
    throw;
  }
}

Manifest::~Manifest() {
  if (fd_ >= 0) ::close(fd_);
}

Manifest::Manifest(Manifest&& other) noexcept
    : file_(std::move(other.file_)),
      folder_(std::move(other.folder_)),
      videos_(other.videos_),
      fd_(std::exchange(other.fd_, -1)),
      size_(other.size_) {}

void Manifest::fail(int number, const std::string& found, const std::string& allowed) const {
  throw InputError(describe({file_, number, ""}, found, allowed));
}

std::string Manifest::name_of(std::string_view path, int number) const {
  fs::path relative = fs::path(path).lexically_normal();
  if (relative.is_absolute()) {
    const fs::path below = relative.lexically_relative(folder_);
    relative = below.empty() || *below.begin() == ".." ? relative.relative_path() : below;
  }
  std::string name =
      videos_ ? relative.replace_extension().generic_string() : sequence_name(relative);
  const std::string trouble = trouble_of_name(name);
  if (!trouble.empty())
    fail(number, fmt::format("'{}', which makes a name with {}", path, trouble),
         "a name in a second column, after a tab");
  return name;
}

ManifestRow Manifest::row_of(std::string_view line, int number) const {
  const size_t tab = line.find('\t');
  const std::string_view path = line.substr(0, tab);
  if (path.empty()) fail(number, "a row that begins with a tab", "PATH, or PATH<tab>NAME");
  if (path.find('\0') != std::string_view::npos) fail(number, "a zero byte", "text");
  ManifestRow row{(folder_ / path).lexically_normal(), {}};
  if (tab == std::string_view::npos) {
    row.name = name_of(path, number);
    return row;
  }
  row.name = line.substr(tab + 1);
  if (row.name.find('\t') != std::string::npos)
    fail(number, "more than two columns", "PATH, or PATH<tab>NAME");
  const std::string trouble = trouble_of_name(row.name);
  if (!trouble.empty())
    fail(number, fmt::format("the name '{}' with {}", row.name, trouble),
         "the name of a folder below the output");
  return row;
}

void Manifest::look_through() {
  std::vector<uint64_t> seen;
  Reader reader(*this);
  while (reader.advance()) seen.push_back(std::hash<std::string>{}(reader.row().name));
  size_ = seen.size();
  std::ranges::sort(seen);
  refuse_doubles(seen);
}

// Names are compared only if their hash numbers are equal.
void Manifest::refuse_doubles(const std::vector<uint64_t>& seen) const {
  if (std::ranges::adjacent_find(seen) == seen.end()) return;
  std::map<std::string, int> lines;
  Reader reader(*this);
  while (reader.advance()) {
    const std::string name = reader.row().name;
    const auto [first, last] =
        std::equal_range(seen.begin(), seen.end(), std::hash<std::string>{}(name));
    if (last - first < 2) continue;
    const auto [earlier, is_new] = lines.emplace(name, reader.line_number());
    if (!is_new)
      fail(reader.line_number(),
           fmt::format("'{}', which is the name of line {}, too", name, earlier->second),
           "names that differ; a second column, after a tab, gives one");
  }
}

bool Manifest::Reader::fill() {
  block_.erase(0, at_);
  at_ = 0;
  const size_t held = block_.size();
  block_.resize(held + kManifestBlock);
  ssize_t got = 0;
  do {
    got =
        ::pread(manifest_->fd_, block_.data() + held, kManifestBlock, static_cast<off_t>(offset_));
  } while (got < 0 && errno == EINTR);
  if (got < 0)
    throw InputError(fmt::format("{}: cannot be read: {}", manifest_->file_, trouble_of_system()));
  block_.resize(held + static_cast<size_t>(got));
  offset_ += static_cast<uint64_t>(got);
  return got > 0;
}

bool Manifest::Reader::next_line() {
  size_t end = 0;
  while ((end = block_.find('\n', at_)) == std::string::npos) {
    if (block_.size() - at_ > kLongestLine) break;
    if (!fill()) {
      end = block_.size();  // the last line may lack its end
      if (at_ == end) return false;
      break;
    }
  }
  ++number_;
  if (end == std::string::npos || end - at_ > kLongestLine)
    manifest_->fail(number_, "a line of more than 16384 bytes", "a path a line");
  line_ = std::string_view(block_).substr(at_, end - at_);
  at_ = std::min(end + 1, block_.size());
  if (line_.ends_with('\r')) line_.remove_suffix(1);
  constexpr std::string_view kByteOrderMark = "\xEF\xBB\xBF";
  if (number_ == 1 && line_.starts_with(kByteOrderMark)) line_.remove_prefix(kByteOrderMark.size());
  return true;
}

bool Manifest::Reader::advance() {
  while (next_line()) {
    const size_t first = line_.find_first_not_of(" \t");
    if (first != std::string_view::npos && line_[first] != '#') return true;
  }
  return false;
}

}  // namespace jobs
}  // namespace walktrack
