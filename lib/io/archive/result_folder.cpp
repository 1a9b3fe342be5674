#include "io/archive/result_folder.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <system_error>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/archive/files.h"

namespace walktrack {
inline namespace io {

namespace fs = std::filesystem;

namespace {

constexpr const char* kPartialFile = "run.partial.json";
constexpr const char* kSceneFile = "scene.yaml";
constexpr const char* kMarker = ".walktrack_";
// `walktrack batch` writes the scene that it makes of a template into the result folder of the
// sequence.
constexpr const char* kSceneMaker = "batch";
constexpr char kNumber = '\t';  // stands for the number in the names of numbered files; no name
                                // contains a tab
constexpr size_t kMaxFolderMarkerBytes = size_t{1} << 24;
constexpr size_t kLongestName = 200;

using Names = std::set<std::string>;

bool is_number(std::string_view text) {
  return !text.empty() && text.find_first_not_of("0123456789") == std::string_view::npos;
}

bool fits(const std::string& name, const std::string& listed) {
  const size_t number = listed.find(kNumber);
  if (number == std::string::npos) return name == listed;
  const std::string_view after = std::string_view(listed).substr(number + 1);
  return name.size() > number + after.size() && name.compare(0, number, listed, 0, number) == 0 &&
         name.ends_with(after) &&
         is_number(std::string_view(name).substr(number, name.size() - number - after.size()));
}

bool lists(const Names& names, const std::string& name) {
  return names.contains(name) || std::ranges::any_of(names, [&](const std::string& listed) {
           return listed.find(kNumber) != std::string::npos && fits(name, listed);
         });
}

bool lists_below(const Names& names, const std::string& folder) {
  const auto next = names.lower_bound(folder + "/");
  return next != names.end() && next->starts_with(folder + "/");
}

std::string marker_name(const std::string& command) {
  return fmt::format("{}{}", kMarker, command);
}

// Names that the marker of an earlier run lists; empty if there is no marker.
Names marked(const fs::path& folder, const std::string& command) {
  const fs::path file = folder / marker_name(command);
  std::error_code none;
  if (!fs::is_regular_file(file, none)) return {};
  std::istringstream lines(read_text_file(file, kMaxFolderMarkerBytes));
  Names names;
  std::string line;
  std::getline(lines, line);  // the heading of the marker
  while (std::getline(lines, line)) names.insert(line);
  return names;
}

void write_marker(const Outputs& outputs, const Names& names) {
  std::string text = fmt::format(
      "# Files of 'walktrack {}', which alone it replaces and removes here.\n", outputs.command);
  for (const std::string& name : names) text.append(name).append("\n");
  write_file_atomically(outputs.folder / marker_name(outputs.command), text);
}

// Throws if the name of a file or folder is not allowed.
void check_name(const std::string& name) {
  const auto unfit = [](char c) {
    const auto byte = static_cast<unsigned char>(c);
    return byte < 0x20 || byte == 0x7f || c == '/';
  };
  if (name.empty() || name[0] == '.' || name.size() > kLongestName ||
      std::ranges::any_of(name, unfit)) {
    throw UsageError(describe({}, fmt::format("'{}' for the name of a file", name),
                              "up to 200 characters without slashes and control characters, no "
                              "leading dot"));
  }
}

void check_file(const std::string& file) {
  const size_t number = file.find(kNumber), folder = file.rfind('/', number);
  if (number == std::string::npos || folder == std::string::npos) return check_name(file);
  std::istringstream folders(file.substr(0, folder));
  for (std::string part; std::getline(folders, part, '/');) check_name(part);
  std::string numbered = file.substr(folder + 1);
  numbered[number - folder - 1] = '0';
  check_name(numbered);
}

// Names of the command's own outputs and of the files that every result has.
Names names_of(const Outputs& outputs) {
  Names names;
  for (const std::string& file : outputs.files) {
    check_file(file);
    if (!names.insert(file).second)
      throw UsageError(
          describe({(outputs.folder / file).string(), 0, ""}, "two files of this name", "one"));
  }
  if (outputs.last == kRunFile) names.insert({kRunFile, kPartialFile});
  return names;
}

struct Entry {
  std::string name;  // relative to the folder
  bool folder;
};

// Lists the entries of the folder and of those of its subfolders that appear in `names`.
void list_entries(const fs::path& folder, const std::string& below, const Names& names,
                  std::vector<Entry>& out) {
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder / below, none)) {
    const std::string name = below + entry.path().filename().string();
    const bool is_folder = entry.is_directory(none) && !entry.is_symlink(none);
    if (is_folder && lists_below(names, name)) {
      list_entries(folder, name + "/", names, out);
    } else {
      out.push_back({name, is_folder});
    }
  }
}

std::vector<Entry> entries(const fs::path& folder, const Names& names) {
  std::vector<Entry> out;
  list_entries(folder, "", names, out);
  return out;
}

bool is_ours(const Entry& entry, const Names& ours, const std::string& command) {
  if (entry.folder) return false;
  if (lists(ours, entry.name)) return true;
  const std::string made_for = name_of_temporary(entry.name);
  return lists(ours, made_for) || made_for == marker_name(command);
}

// Whether a command that writes `names` would overwrite this entry.
bool is_in_the_way(const Entry& entry, const Names& names) {
  const size_t slash = entry.name.rfind('/');
  return lists(names, entry.name) || lists_below(names, entry.name) ||
         (slash != std::string::npos && lists_below(names, entry.name.substr(0, slash)));
}

bool lies_in(const fs::path& input, const fs::path& folder) {
  const fs::path place = fs::weakly_canonical(folder);
  const fs::path given = fs::absolute(input).lexically_normal();
  return fs::weakly_canonical(given.parent_path()) == place ||
         fs::weakly_canonical(given) == place || fs::weakly_canonical(given).parent_path() == place;
}

constexpr const char* kElsewhere = "a folder of the command's own: choose another with -o";

void refuse_inputs(const Outputs& outputs, const Names& made_for_it) {
  for (const fs::path& input : outputs.inputs) {
    if (input.empty() || !lies_in(input, outputs.folder)) continue;
    const std::string name = input.filename().string();
    if (made_for_it.contains(name)) continue;
    throw UsageError(describe({outputs.folder.string(), 0, ""},
                              fmt::format("'{}', which the command reads", name), kElsewhere));
  }
}

void refuse_complete(const Outputs& outputs) {
  std::error_code none;
  const fs::path last = outputs.folder / outputs.last;
  if (outputs.last.empty() || !fs::exists(last, none)) return;
  if (outputs.last != kRunFile)
    throw UsageError(fmt::format("{} exists; -y overwrites it", last.string()));
  throw UsageError(
      fmt::format("{} holds a complete result; -y overwrites it", outputs.folder.string()));
}

void remove_earlier(const Outputs& outputs, const Names& ours,
                    std::span<const std::string_view> kept) {
  const auto is_kept = [&](const std::string& name) {
    return std::ranges::find(kept, name) != kept.end();
  };
  const std::vector<Entry> found = entries(outputs.folder, ours);
  if (ours.contains(outputs.last) && !is_kept(outputs.last))
    fs::remove(outputs.folder / outputs.last);
  for (const Entry& entry : found)
    if (is_ours(entry, ours, outputs.command) && !is_kept(entry.name))
      fs::remove(outputs.folder / entry.name);
  std::error_code not_empty;
  for (const std::string& name : ours)
    for (size_t at = name.rfind('/'); at != std::string::npos && at > 0;
         at = name.rfind('/', at - 1))
      fs::remove(outputs.folder / name.substr(0, at), not_empty);
}

}  // namespace

std::string numbered_files(const std::string& folder, const std::string& ending,
                           const std::string& beginning) {
  return fmt::format("{}/{}{}{}", folder, beginning, kNumber, ending);
}

void refuse_what_is_not_ours(const Outputs& outputs) {
  const Names names = names_of(outputs);
  if (!fs::exists(outputs.folder)) return;
  if (!fs::is_directory(outputs.folder)) {
    throw UsageError(
        fmt::format("{} is a file, allowed: a folder for the results", outputs.folder.string()));
  }
  // The entries are listed before the markers are read, because another worker marks its files
  // before it writes them.
  std::vector<Entry> found = entries(outputs.folder, names);
  const Names ours = marked(outputs.folder, outputs.command);
  const Names made_for_it = marked(outputs.folder, kSceneMaker);
  refuse_inputs(outputs, made_for_it);
  // A scene file comes first, because it shows best to whom the folder belongs.
  std::stable_partition(found.begin(), found.end(),
                        [](const Entry& e) { return e.name == kSceneFile; });
  for (const Entry& entry : found) {
    if (entry.name == kSceneFile && !lists(ours, entry.name) && !lists(made_for_it, entry.name))
      throw UsageError(describe({outputs.folder.string(), 0, ""}, "a scene", kElsewhere));
    if (!is_in_the_way(entry, names) || is_ours(entry, ours, outputs.command)) continue;
    throw UsageError(describe(
        {(outputs.folder / entry.name).string(), 0, ""},
        fmt::format("a file that 'walktrack {}' has not marked as its own", outputs.command),
        "none of this name: move it away, or choose another folder with -o"));
  }
}

void refuse_input(const fs::path& file, const std::vector<fs::path>& inputs) {
  std::error_code none;
  for (const fs::path& input : inputs)
    if (fs::equivalent(file, input, none))
      throw UsageError(describe({file.string(), 0, ""}, "a file that the command reads",
                                "another one to write"));
}

bool is_complete_result(const fs::path& folder) {
  std::error_code ignored;
  return fs::is_regular_file(folder / kRunFile, ignored);
}

void remove_marked(const fs::path& folder, const std::string& command) {
  remove_earlier({folder, command, {}}, marked(folder, command), {});
  fs::remove(folder / marker_name(command));
}

ResultFolder::ResultFolder(const Outputs& outputs, bool overwrite,
                           std::span<const std::string_view> kept)
    : folder_(outputs.folder), files_(names_of(outputs)) {
  refuse_what_is_not_ours(outputs);
  if (!overwrite) refuse_complete(outputs);
  fs::create_directories(folder_);
  const Names earlier = marked(folder_, outputs.command);
  remove_earlier(outputs, earlier, kept);
  if (earlier != files_) write_marker(outputs, files_);
}

fs::path ResultFolder::file(const std::string& name) const {
  if (!lists(files_, name)) throw std::logic_error(name + " is none of the outputs");
  return folder_ / name;
}

void ResultFolder::remove(std::span<const std::string_view> names) const {
  for (const std::string_view name : names) fs::remove(file(std::string(name)));
}

void ResultFolder::write(const std::string& name, std::string_view content) const {
  write_file_atomically(file(name), content);
}

void ResultFolder::finish(std::string_view run_json) const { write(kRunFile, run_json); }

void ResultFolder::finish_partial(std::string_view run_json) const {
  write(kPartialFile, run_json);
}

}  // namespace io
}  // namespace walktrack
