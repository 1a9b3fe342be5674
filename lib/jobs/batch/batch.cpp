#include "jobs/batch/batch.h"

#include <algorithm>
#include <chrono>
#include <list>
#include <optional>
#include <thread>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/archive/result_folder.h"
#include "jobs/batch/batch_changes.h"
#include "jobs/batch/batch_report.h"
#include "jobs/batch/sequence_list.h"
#include "jobs/batch/workers/batch_work.h"
#include "jobs/batch/workers/sequence_claim.h"
#include "jobs/batch/workers/work_folder.h"

namespace walktrack {
inline namespace jobs {

namespace fs = std::filesystem;

namespace {

using Share = SequenceList::Share;

constexpr auto kPollInterval = std::chrono::milliseconds(20);
constexpr auto kRenewInterval = std::chrono::seconds(10);

// What is to be done in this worker's share, one byte for each sequence.
struct BatchPlan {
  std::vector<Todo> todo;
  size_t count = 0;  // of the sequences that are to be done
  ChangedResults left;
};

// Inspects every sequence of the share once, before work begins.
BatchPlan plan_of(const BatchJob& job, const SequenceList& list) {
  BatchPlan plan;
  auto own = list.sequences(Share::kOwn);
  while (const auto sequence = own.next()) {
    refuse_place(job, *sequence, Todo::kNothing);
    const Decision decision = decide(job, *sequence);
    refuse_place(job, *sequence, decision.todo);
    if (!decision.changes.empty()) plan.left.add(sequence->name, decision.changes);
    plan.count += decision.todo != Todo::kNothing;
    plan.todo.push_back(decision.todo);
  }
  return plan;
}

struct Next {
  Sequence sequence;
  Todo todo;
  bool stolen;
};

// The sequences that are to be done, one at a time: first the worker's own share, then sequences of
// other shares that nobody has begun.
class Queue {
 public:
  Queue(const BatchJob& job, const SequenceList& list, const BatchPlan& plan)
      : job_(job),
        plan_(plan),
        own_(list.sequences(Share::kOwn)),
        others_(list.sequences(Share::kOthers)),
        steals_(job.steal && job.shards > 1) {}

  std::optional<Next> next() {
    while (at_ < plan_.todo.size()) {
      auto sequence = own_.next();
      const Todo todo = plan_.todo[at_++];
      if (sequence && todo != Todo::kNothing) return Next{std::move(*sequence), todo, false};
    }
    while (steals_) {
      auto sequence = others_.next();
      if (!sequence) break;
      if (may_steal(*sequence)) return Next{std::move(*sequence), Todo::kFirst, true};
    }
    return std::nullopt;
  }

 private:
  // Failures of a sequence, and files that are in the way, are reported by the worker in whose
  // share it is.
  bool may_steal(const Sequence& sequence) const {
    if (fs::exists(sequence.output / kFailureFile)) return false;
    if (decide(job_, sequence).todo != Todo::kFirst) return false;
    try {
      refuse_place(job_, sequence, Todo::kFirst);
    } catch (const UsageError&) {
      return false;
    }
    return true;
  }

  const BatchJob& job_;
  const BatchPlan& plan_;
  SequenceList::Cursor own_, others_;
  bool steals_;
  size_t at_ = 0;
};

class Runner {
 public:
  Runner(const BatchJob& job, const JobControl& control, const SequenceList& list,
         const BatchPlan& plan, fs::file_time_type began)
      : job_(job), control_(control), queue_(job, list, plan), total_(plan.count), began_(began) {}

  void run() {
    while (fill() || !running_.empty()) {
      if (control_.stopping()) stop();
      collect();
      control_.progress("sequences", done_, total_);
      renew();
      if (!running_.empty()) std::this_thread::sleep_for(kPollInterval);
    }
  }
  bool interrupted() const { return stopped_; }
  int stolen() const { return stolen_; }

 private:
  void stop() {
    if (stopped_) return;
    stopped_ = true;
    for (const RunningSequence& running : running_)
      if (running.child) running.child->ask_to_stop();
  }

  void renew() {
    if (std::chrono::steady_clock::now() - renewed_ <= kRenewInterval) return;
    for (const RunningSequence& running : running_) running.claim.renew();
    renewed_ = std::chrono::steady_clock::now();
  }

  // Starts sequences until all processes are busy. Returns whether any sequence is left.
  bool fill() {
    while (!stopped_ && static_cast<int>(running_.size()) < job_.jobs) {
      if (control_.stopping()) stop();
      const auto next = stopped_ ? std::nullopt : queue_.next();
      if (!next) return false;
      auto running = start_sequence(job_, next->sequence, next->todo, began_);
      if (running && next->stolen) {
        ++stolen_;
        ++total_;
      }
      if (!running && !next->stolen) ++done_;
      if (running) running_.push_back(std::move(*running));
      renew();
    }
    return !stopped_;
  }

  void collect() {
    for (auto running = running_.begin(); running != running_.end();) {
      std::optional<ChildEnd> end;
      if (running->child && !(end = running->child->poll())) {
        ++running;
        continue;
      }
      end_sequence(job_, *running, end, stopped_, [&] { renew(); });
      const SequenceResult result = result_of(running->sequence);
      if (result.state == SequenceState::kFailed)
        control_.say(fmt::format("{}: {}", running->sequence.name, result.reason));
      running = running_.erase(running);
      ++done_;
    }
  }

  const BatchJob& job_;
  const JobControl& control_;
  Queue queue_;
  std::list<RunningSequence> running_;
  size_t total_, done_ = 0;
  fs::file_time_type began_;
  std::chrono::steady_clock::time_point renewed_ = std::chrono::steady_clock::now();
  bool stopped_ = false;
  int stolen_ = 0;
};

// Removes the claim of a worker that was killed after it had written a sequence's last file.
void clear_dead_claims(const SequenceList& list) {
  auto own = list.sequences(Share::kOwn);
  while (const auto sequence = own.next())
    if (is_complete_result(sequence->output)) clear_dead_claim(sequence->output);
}

}  // namespace

BatchOutcome run_batch(const BatchJob& job, const JobControl& control) {
  refuse_work_in_output(job);
  const SequenceList list(job);
  refuse_what_is_not_ours(batch_outputs(job));
  fs::create_directories(job.output);
  const fs::file_time_type began = time_of_output(job);
  const BatchPlan plan = plan_of(job, list);
  clear_dead_claims(list);
  Runner runner(job, control, list, plan, began);
  runner.run();
  if (reports_at_end(job)) write_batch_reports(job, list);
  BatchOutcome outcome{.stolen = runner.stolen(),
                       .changed = plan.left.count(),
                       .changes = plan.left.text(),
                       .interrupted = runner.interrupted()};
  auto own = list.sequences(Share::kOwn);
  while (const auto sequence = own.next()) add_result(*sequence, result_of(*sequence), outcome);
  return outcome;
}

}  // namespace jobs
}  // namespace walktrack
