#include "jobs/batch/batch.h"

#include <algorithm>
#include <chrono>
#include <cstring>
#include <deque>
#include <list>
#include <map>
#include <optional>
#include <thread>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/archive/files.h"
#include "io/archive/result_folder.h"
#include "io/scene/scene_template.h"
#include "jobs/batch/batch_changes.h"
#include "jobs/batch/folder_lock.h"

namespace walktrack {

namespace fs = std::filesystem;

namespace {

constexpr auto kPollInterval = std::chrono::milliseconds(20);
constexpr auto kRenewInterval = std::chrono::seconds(10);
constexpr size_t kMostLogBytes = size_t{1} << 30;
constexpr const char* kLogFile = "log.txt";
constexpr int kDegradedExit = 4, kInterruptedExit = 130;  // of the sequence's program

// A sequence that is being done.
struct Running {
  Sequence sequence;
  FolderLock claim;
  ChildProcess child;
};

// The last line that the program said, without its name in front.
std::string last_words(const fs::path& log) {
  std::string text = fs::exists(log) ? read_text_file(log, kMostLogBytes) : "";
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

// Results stay below the output folder: what leads elsewhere was not made by a batch.
void refuse_links(const BatchJob& job, const std::vector<Sequence>& sequences) {
  for (const Sequence& sequence : sequences) {
    fs::path folder = job.output;
    for (const fs::path& part : fs::path(sequence.name)) {
      folder /= part;
      if (fs::is_symlink(folder))
        throw UsageError(
            describe({folder.string(), 0, ""}, "a link", "a folder of the batch's own"));
    }
  }
}

// What this process writes into the sequence's folder; its own program does the rest.
Outputs outputs_of(const Sequence& sequence) {
  if (sequence.video.empty())
    return {sequence.output, "batch", {kLogFile, kFailureFile}, {sequence.scene}, ""};
  return {sequence.output, "batch", {kLogFile, kFailureFile, "scene.yaml"}, {sequence.video}, ""};
}

// When the file was written; nullopt if there is none.
std::optional<fs::file_time_type> time_of(const fs::path& file) {
  std::error_code none;
  const auto time = fs::last_write_time(file, none);
  return none ? std::nullopt : std::optional(time);
}

// When an end of the sequence was noted last, with or without success; nullopt: never.
struct LastEnd {
  std::optional<fs::file_time_type> completed, failed;
};

LastEnd last_end(const Sequence& sequence) {
  const bool complete = is_complete_result(sequence.output);
  return {complete ? time_of(sequence.output / "run.json") : std::nullopt,
          time_of(sequence.output / kFailureFile)};
}

// A sequence that is to be done, and how it stood when this worker began.
struct Waiting {
  Sequence sequence;
  LastEnd before;

  // Whether another worker has done it since.
  bool done_by_another() const {
    const LastEnd now = last_end(sequence);
    return now.completed > before.completed || now.failed > before.failed;
  }
};

// If it is still to be done and nobody else is at it: clears why an earlier try failed, and starts.
std::optional<Running> start(const BatchJob& job, const Waiting& waiting) {
  const Sequence& sequence = waiting.sequence;
  if (waiting.done_by_another()) return std::nullopt;
  fs::create_directories(sequence.output);
  std::optional<FolderLock> claim = FolderLock::try_take(sequence.output);
  // Another worker may have done it between the look and the claim.
  if (!claim || waiting.done_by_another()) return std::nullopt;
  const ResultFolder folder(outputs_of(sequence), true);
  if (!sequence.video.empty())
    folder.write("scene.yaml", scene_for_video(job.scene_template, sequence.video));
  std::vector<std::string> words = job.command;
  words.insert(words.end(),
               {sequence.scene.string(), "-o", sequence.output.string(), "--resume", "-y"});
  return Running{sequence, std::move(*claim),
                 ChildProcess(words, folder.file(kLogFile), job.limits)};
}

// A worker that was killed after a sequence's last file has left its claim, which a claim taken
// here gives back at once.
void clear_dead_locks(const std::vector<Sequence>& sequences) {
  for (const Sequence& sequence : sequences)
    if (is_complete_result(sequence.output) && fs::exists(sequence.output / FolderLock::kFile))
      FolderLock::try_take(sequence.output);
}

void note_end(const BatchJob& job, const Running& running, const ChildEnd& end, bool stopping) {
  if (is_complete_result(running.sequence.output)) {
    if (end.exit_code == 0 || end.exit_code == kDegradedExit) return;
  }
  if (stopping && (end.exit_code == kInterruptedExit || end.signal)) return;
  const fs::path& folder = running.sequence.output;
  write_file_atomically(folder / kFailureFile, failure_reason(job, end, folder / kLogFile) + "\n");
}

// How the sequences stand, by name.
std::map<std::string, LastEnd> last_ends(const std::vector<Sequence>& sequences) {
  std::map<std::string, LastEnd> out;
  for (const Sequence& sequence : sequences) out[sequence.name] = last_end(sequence);
  return out;
}

class Runner {
 public:
  // `before`: how the sequences stood, by name, before it was asked which are to be done.
  Runner(const BatchJob& job, const JobControl& control, const std::vector<Sequence>& sequences,
         const std::map<std::string, LastEnd>& before)
      : job_(job), control_(control), total_(sequences.size()) {
    for (const Sequence& sequence : sequences) {
      refuse_what_is_not_ours(outputs_of(sequence));
      waiting_.push_back({sequence, before.at(sequence.name)});
    }
  }

  void run() {
    auto renewed = std::chrono::steady_clock::now();
    while (!waiting_.empty() || !running_.empty()) {
      if (control_.stopping()) stop();
      fill();
      collect();
      control_.progress("sequences", total_ - waiting_.size() - running_.size(), total_);
      if (std::chrono::steady_clock::now() - renewed > kRenewInterval) {
        for (const Running& running : running_) running.claim.renew();
        renewed = std::chrono::steady_clock::now();
      }
      if (!running_.empty()) std::this_thread::sleep_for(kPollInterval);
    }
  }
  bool interrupted() const { return stopped_; }

 private:
  void stop() {
    if (stopped_) return;
    stopped_ = true;
    waiting_.clear();
    for (const Running& running : running_) running.child.ask_to_stop();
  }

  void fill() {
    while (!waiting_.empty() && static_cast<int>(running_.size()) < job_.jobs) {
      const Waiting next = waiting_.front();
      waiting_.pop_front();
      if (auto running = start(job_, next)) running_.push_back(std::move(*running));
    }
  }

  void collect() {
    for (auto running = running_.begin(); running != running_.end();) {
      const auto end = running->child.poll();
      if (!end) {
        ++running;
        continue;
      }
      note_end(job_, *running, *end, stopped_);
      const SequenceResult result = result_of(running->sequence);
      if (result.state == SequenceState::kFailed) {
        control_.say(fmt::format("{}: {}", running->sequence.name, result.reason));
      }
      running = running_.erase(running);
    }
  }

  const BatchJob& job_;
  const JobControl& control_;
  std::deque<Waiting> waiting_;
  std::list<Running> running_;
  size_t total_;
  bool stopped_ = false;
};

}  // namespace

BatchOutcome run_batch(const BatchJob& job, const JobControl& control) {
  const std::vector<Sequence> all = sequences_of(job);
  if (all.empty()) {
    throw UsageError(describe({job.folder.string(), 0, ""}, "no sequence",
                              job.scene_template.empty()
                                  ? "scene*.yaml files, or .yaml files that list cameras"
                                  : "video files"));
  }
  refuse_what_is_not_ours(batch_outputs(job));
  const std::vector<Sequence> own = shard_of(all, job.shard, job.shards);
  refuse_links(job, own);
  const std::map<std::string, LastEnd> before = last_ends(own);
  const BatchWork work = work_of(job);
  Runner runner(job, control, work.to_do, before);
  fs::create_directories(job.output);
  clear_dead_locks(own);
  runner.run();
  write_batch_reports(all, batch_outputs(job));
  BatchOutcome outcome{.changed = static_cast<int>(work.left.size()),
                       .changes = changes_text(work.left),
                       .interrupted = runner.interrupted()};
  for (const Sequence& sequence : own) {
    const SequenceState state = result_of(sequence).state;
    outcome.complete += state == SequenceState::kComplete;
    outcome.degraded += state == SequenceState::kDegraded;
    outcome.failed += state == SequenceState::kFailed;
    outcome.waiting += state == SequenceState::kWaiting;
  }
  return outcome;
}

}  // namespace walktrack
