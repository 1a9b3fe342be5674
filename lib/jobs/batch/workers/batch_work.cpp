#include "jobs/batch/workers/batch_work.h"

#include <cstring>
#include <vector>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/scene/scene_template.h"
#include "jobs/batch/workers/work_folder.h"

namespace walktrack {
inline namespace jobs {

namespace fs = std::filesystem;

namespace {

constexpr size_t kMostLogBytes = size_t{1} << 30;
constexpr const char* kLogFile = "log.txt";
constexpr const char* kSceneOfVideo = "scene.yaml";
constexpr int kDegradedExit = 4, kInterruptedExit = 130;  // exit codes of the sequence's program

std::string log_text(const fs::path& log) {
  return fs::exists(log) ? read_text_file(log, kMostLogBytes) : "";
}

// The last line of the program's output, without the name of the program in front.
std::string last_words(const fs::path& log) {
  std::string text = log_text(log);
  while (text.ends_with('\n')) text.pop_back();
  text.erase(0, text.rfind('\n') + 1);
  constexpr std::string_view kProgram = "walktrack: ";
  if (text.starts_with(kProgram)) text.erase(0, kProgram.size());
  return text;
}

std::string failure_reason(const BatchJob& job, const ChildEnd& end, const fs::path& log) {
  if (end.timed_out) return fmt::format("took longer than {:g} s", job.limits.seconds);
  const std::string words = last_words(log);
  if (end.signal) {
    return fmt::format("ended by signal {} ({}){}{}", end.signal, strsignal(end.signal),
                       words.empty() ? "" : ": ", words);
  }
  return fmt::format("exit {}{}{}", end.exit_code, words.empty() ? "" : ": ", words);
}

// What this process writes into a folder of the sequence; everything else is written by its own
// program.
Outputs outputs_of(const Sequence& sequence, const fs::path& folder) {
  if (sequence.video.empty())
    return {folder, "batch", {kLogFile, kFailureFile}, {sequence.scene}, ""};
  return {folder, "batch", {kLogFile, kFailureFile, kSceneOfVideo}, {sequence.video}, ""};
}

// Whether another worker has recorded an end, with or without success, since this one began.
bool done_by_another(const Sequence& sequence, Todo todo, fs::file_time_type began) {
  const auto is_later = [&](const fs::path& file) {
    std::error_code none;
    const auto time = fs::last_write_time(file, none);
    return !none && time > began;
  };
  if (is_later(sequence.output / kFailureFile)) return true;
  return todo == Todo::kFirst ? is_complete_result(sequence.output)
                              : is_later(sequence.output / kRunFile);
}

void write_scene(const BatchJob& job, const Sequence& sequence, const ResultFolder& folder) {
  if (sequence.video.empty()) return;
  const std::string scene = scene_for_video(job.scene_template, sequence.video);
  folder.write(kSceneOfVideo, scene);
  const fs::path tracked = tracked_scene(job, sequence);
  if (tracked != folder.file(kSceneOfVideo)) write_file_atomically(tracked, scene);
}

// Whether a worker was killed after the result was complete and before it was moved to its place.
bool is_made(const BatchJob& job, const Sequence& sequence, const fs::path& folder) {
  return !job.work.empty() && is_complete_result(folder) &&
         (!job.config || changes_in(folder, tracked_scene(job, sequence), *job.config).empty());
}

void note_failure(const BatchJob& job, const Sequence& sequence, const std::string& reason) {
  const fs::path log = tracked_in(job, sequence) / kLogFile;
  if (!job.work.empty()) {
    const ResultFolder folder(outputs_of(sequence, sequence.output), true);
    folder.write(kLogFile, log_text(log));
    if (!sequence.video.empty())
      folder.write(kSceneOfVideo, scene_for_video(job.scene_template, sequence.video));
    clear_work(job, sequence);
  }
  write_file_atomically(sequence.output / kFailureFile, reason + "\n");
}

}  // namespace

void refuse_links(const fs::path& output, const fs::path& name) {
  fs::path folder = output;
  for (const fs::path& part : name) {
    folder /= part;
    const fs::file_status status = fs::symlink_status(folder);
    if (!fs::exists(status)) return;
    if (fs::is_symlink(status))
      throw UsageError(describe({folder.string(), 0, ""}, "a link", "a folder of the batch's own"));
  }
}

void refuse_place(const BatchJob& job, const Sequence& sequence, Todo todo) {
  refuse_links(job.output, sequence.name);
  if (todo != Todo::kNothing) refuse_what_is_not_ours(outputs_of(sequence, sequence.output));
}

fs::file_time_type time_of_output(const BatchJob& job) {
  const fs::path probe = new_temporary(job.output / "summary.csv");
  const auto now = fs::last_write_time(probe);
  fs::remove(probe);
  return now;
}

std::optional<RunningSequence> start_sequence(const BatchJob& job, const Sequence& sequence,
                                              Todo todo, fs::file_time_type began) {
  if (done_by_another(sequence, todo, began)) return std::nullopt;
  std::optional<SequenceClaim> claim = SequenceClaim::try_take(sequence.output);
  // Another worker may have finished it between the inspection and the claim.
  if (!claim || done_by_another(sequence, todo, began)) return std::nullopt;
  const fs::path place = tracked_in(job, sequence);
  std::vector<std::string_view> kept;
  const bool is_there = !job.work.empty() && is_complete_result(place);
  if (is_there) kept.assign({kLogFile, kSceneOfVideo});
  const ResultFolder folder(outputs_of(sequence, place), true, kept);
  write_scene(job, sequence, folder);
  RunningSequence running{sequence, std::move(*claim), std::nullopt};
  if (is_made(job, sequence, place)) return running;
  if (is_there) fs::remove(folder.file(kLogFile));
  std::vector<std::string> words = job.command;
  words.insert(words.end(),
               {tracked_scene(job, sequence).string(), "-o", place.string(), "--resume", "-y"});
  running.child.emplace(words, folder.file(kLogFile), job.limits);
  return running;
}

void end_sequence(const BatchJob& job, const RunningSequence& running,
                  const std::optional<ChildEnd>& end, bool stopping,
                  const std::function<void()>& alive) {
  const Sequence& sequence = running.sequence;
  const fs::path place = tracked_in(job, sequence);
  const bool well = !end || end->exit_code == 0 || end->exit_code == kDegradedExit;
  if (well && is_complete_result(place)) {
    // A worker that has taken over the claim, because it took this one for dead, moves its own
    // result.
    if (job.work.empty() || !running.claim.is_held()) return;
    try {
      show_result(job, sequence, running.claim, alive);
    } catch (const std::exception& error) {  // a full disk: it stays in the work folder
      note_failure(job, sequence, error.what());
    }
    return;
  }
  if (end && stopping && (end->exit_code == kInterruptedExit || end->signal)) return;
  note_failure(job, sequence,
               end ? failure_reason(job, *end, place / kLogFile) : "its result is gone");
}

}  // namespace jobs
}  // namespace walktrack
