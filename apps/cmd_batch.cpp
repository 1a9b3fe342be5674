// walktrack batch: every sequence below a folder.
#include <filesystem>
#include <optional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "core/errors.h"
#include "core/parallel_for.h"
#include "jobs/batch/batch.h"
#include "jobs/batch/batch_changes.h"
#include "jobs/batch/batch_report.h"
#include "jobs/batch/batch_sequences.h"
#include "jobs/batch/sequence_list.h"
#include "jobs/batch/workers/shard.h"
#include "terminal.h"

namespace walktrack {

namespace fs = std::filesystem;
namespace po = boost::program_options;

namespace {

// This program with the options that it was given itself, to track one sequence.
std::vector<std::string> track_command(const CommonOptions& common, int jobs, bool ignore_checks) {
  std::vector<std::string> words{std::filesystem::read_symlink("/proc/self/exe").string(), "track"};
  if (!common.config_file.empty()) words.insert(words.end(), {"-c", common.config_file});
  for (const std::string& setting : common.settings) words.insert(words.end(), {"--set", setting});
  if (!common.seed.empty()) words.insert(words.end(), {"--seed", common.seed});
  if (ignore_checks) words.emplace_back("--ignore-checks");
  const int share = std::max(1, hardware_threads() / std::max(1, jobs));
  words.insert(words.end(),
               {"--threads", common.threads.empty() ? std::to_string(share) : common.threads});
  return words;
}

int list(const BatchJob& job) {
  const SequenceList sequences(job);
  auto own = sequences.sequences(SequenceList::Share::kOwn);
  while (const auto sequence = own.next())
    fmt::print("{}\t{}\n", state_name(result_of(*sequence).state), sequence->name);
  return kDone;
}

int list_work(const BatchJob& job) {
  each_to_do(job, SequenceList(job),
             [](const Sequence& sequence) { fmt::print("{}\n", sequence.name); });
  return kDone;
}

int exit_code(const BatchOutcome& outcome) {
  if (outcome.interrupted || stop_request()) return kInterrupted;
  // Sequences of other workers do not count for the exit code of this one.
  if (outcome.failed + outcome.waiting - outcome.elsewhere > 0) return kFailed;
  return outcome.degraded > 0 ? kDegraded : kDone;
}

// CPU seconds for a second of video; nullopt if no result states it.
std::optional<double> cost_of(const BatchOutcome& outcome) {
  return outcome.video_seconds > 0 ? std::optional(outcome.cpu_seconds / outcome.video_seconds)
                                   : std::nullopt;
}

nlohmann::ordered_json or_null(const std::optional<double>& value) {
  return value ? nlohmann::ordered_json(*value) : nlohmann::ordered_json();
}

std::string last_words(const BatchJob& job, const BatchOutcome& outcome) {
  std::string text = fmt::format("{} complete, {} degraded, {} failed, {} left", outcome.complete,
                                 outcome.degraded, outcome.failed, outcome.waiting);
  if (outcome.elsewhere > 0)
    text += fmt::format(" (other workers are tracking {} of them)", outcome.elsewhere);
  if (outcome.stolen > 0) text += fmt::format(", {} taken from other shares", outcome.stolen);
  text += reports_at_end(job) ? fmt::format("; see {}", (job.output / "batch.html").string())
                              : "; --report writes the summary of all shares";
  if (const auto cost = cost_of(outcome))
    text += fmt::format("\n{:.1f} CPU seconds per second of video ({:.0f} s for {:.0f} s)", *cost,
                        outcome.cpu_seconds, outcome.video_seconds);
  return text;
}

std::string result_line(const BatchJob& job, const BatchOutcome& outcome, int code) {
  const nlohmann::ordered_json line = {{"format", "walktrack result 1"},
                                       {"command", "batch"},
                                       {"status", outcome.interrupted ? "interrupted" : "done"},
                                       {"exit", code},
                                       {"result", job.output.string()},
                                       {"open", (job.output / "batch.html").string()},
                                       {"complete", outcome.complete},
                                       {"degraded", outcome.degraded},
                                       {"failed", outcome.failed},
                                       {"waiting", outcome.waiting},
                                       {"elsewhere", outcome.elsewhere},
                                       {"stolen", outcome.stolen},
                                       {"cpu_seconds", outcome.cpu_seconds},
                                       {"video_seconds", outcome.video_seconds},
                                       {"cpu_seconds_per_video_second", or_null(cost_of(outcome))}};
  return line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

// The state of the whole output folder, for all workers.
int report(const BatchJob& job, const JobControl& control, bool json_line) {
  const SequenceList all(job);
  const BatchOutcome counts = write_batch_reports(job, all);
  const int code = counts.complete == static_cast<int>(all.size()) ? kDone : kFailed;
  control.say(last_words(job, counts));
  if (json_line) fmt::print("{}", result_line(job, counts, code));
  return code;
}

// Notes on the places of the sequences, once.
void check_places(const BatchJob& job, const CommandLine& line) {
  if (job.folder.empty() && job.manifest.empty())
    throw UsageError("FOLDER is missing, or --manifest; see 'walktrack batch --help'");
  if (!job.folder.empty() && !job.manifest.empty())
    throw UsageError("FOLDER and --manifest exclude each other");
  if (line.given("manifest") && job.manifest.empty())
    throw UsageError(describe({"", 0, "--manifest"}, "no name", "a file, or - for standard input"));
  if (line.given("work") && job.work.empty())
    throw UsageError(describe({"", 0, "--work"}, "no name", "a folder"));
  if (job.bids && !job.manifest.empty())
    throw UsageError("--bids and --manifest exclude each other");
  if (job.bids && job.scene_template.empty())
    throw UsageError("--bids needs --scene: the scene of the camera that took the videos");
  if (job.steal && job.retry_failed)
    throw UsageError(
        "--steal and --retry-failed exclude each other: only the worker of a share tries its "
        "failed sequences again");
  if (job.jobs < 1) throw UsageError("--jobs: found less than 1, allowed: from 1");
}

// Values of the command line.
struct BatchArguments {
  BatchJob job;
  std::string folder, scene_template, work, shard = "1/1";
  bool list_only = false, dry_run = false, report_only = false, resume = false;
  bool ignore_checks = false, json_line = false;
};

void add_options(CommandLine& line, BatchArguments& given) {
  auto add = line.options().add_options();
  add("scene", po::value(&given.scene_template)->value_name("FILE"),
      "track every video below FOLDER as if it were the video of this scene");
  add("manifest", po::value(&given.job.manifest)->value_name("FILE"),
      "a list of scenes instead of FOLDER (with --scene, of videos): one path in each line, "
      "optionally followed by a tab and the name of its result; - is standard input");
  add("bids", po::bool_switch(&given.job.bids),
      "FOLDER is a BIDS data set: track its sub-<label>/..._video files with --scene and write "
      "Motion-BIDS tables; the default output is FOLDER/derivatives/walktrack");
  add("jobs,j", po::value(&given.job.jobs)->default_value(1)->value_name("N"),
      "number of sequences that are tracked at the same time");
  add("shard", po::value(&given.shard)->value_name("i/n"),
      "track every n-th sequence, beginning with the i-th; auto: the numbers that Slurm or AWS "
      "Batch gives this worker; auto/n: the number that a Kubernetes Indexed Job of n gives it");
  add("steal", po::bool_switch(&given.job.steal),
      "after its own share, this worker tracks sequences of other shares that no worker has begun");
  add("work", po::value(&given.work)->value_name("DIR"),
      "track below this folder, on a disk of this machine; a result is moved to the output folder "
      "when it is complete");
  add("time-limit", po::value(&given.job.limits.seconds)->value_name("S"),
      "longest time of one sequence");
  add("memory-limit", po::value(&given.job.limits.memory_mb)->value_name("MB"),
      "largest memory of one sequence");
  add("resume", po::bool_switch(&given.resume),
      "skip complete sequences and continue from checkpoints; this is the default, so that the "
      "option only excludes --yes");
  add("list", po::bool_switch(&given.list_only), "print the sequences and their state, do nothing");
  add("retry-failed", po::bool_switch(&given.job.retry_failed),
      "track only the sequences that failed before");
  add("dry-run", po::bool_switch(&given.dry_run),
      "print the sequences that would be tracked, do nothing");
  add("ignore-checks", po::bool_switch(&given.ignore_checks),
      "track scenes even if their checks fail (see walktrack check); their reports say so");
  add("report", po::bool_switch(&given.report_only),
      "write only the summary of the existing results");
  add("json-line", po::bool_switch(&given.json_line),
      "print the number of sequences by outcome, or the error, as one line of JSON");
  line.operand("FOLDER", &given.folder, true);
}

}  // namespace

int run_batch(const Arguments& arguments) {
  BatchArguments given;
  CommandLine line(
      {.name = "batch",
       .operands = "[FOLDER]",
       .about = "Tracks every scene below FOLDER, or in the list --manifest, each in a process "
                "of\nits own, and continues after failures.\nIf it is run again, it tracks the "
                "sequences that are not complete, from their last\ncheckpoints (--resume, the "
                "default); with -y also those that were made with other\nsettings or inputs. "
                "Several machines may share one output folder.",
       .example = "walktrack batch data -o out/batch --jobs 2"});
  add_options(line, given);
  if (!line.parse(arguments)) return kDone;
  BatchJob& job = given.job;
  job.folder = given.folder;
  job.scene_template = given.scene_template;
  job.work = given.work;
  check_places(job, line);
  if (given.resume && line.common().overwrite) {
    throw UsageError(
        "--resume and --yes exclude each other: results made with other settings or inputs are "
        "either left as they are or tracked again");
  }
  const Shard share = shard_from(given.shard, process_environment());
  job.shard = share.index;
  job.shards = share.count;
  const bool in_data_set = job.bids && !line.given("output");
  job.output =
      in_data_set ? job.folder / "derivatives" / "walktrack" : fs::path(line.required_output());
  job.overwrite = line.common().overwrite;
  if (given.list_only) return list(job);
  Terminal terminal(line.common());
  if (given.report_only) return report(job, terminal.control(), given.json_line);
  job.config = line.config();  // a mistake in it would make every sequence fail
  if (given.dry_run) return list_work(job);
  job.command = track_command(line.common(), job.jobs, given.ignore_checks);
  const JobControl control = terminal.control();
  const BatchOutcome outcome = run_batch(job, control);
  control.say(last_words(job, outcome));
  if (outcome.changed > 0 && !outcome.interrupted) {
    throw UsageError(
        fmt::format("{} sequences are left as they are, because they were made with other settings "
                    "or inputs; -y tracks them again{}",
                    outcome.changed, outcome.changes));
  }
  const int code = exit_code(outcome);
  if (given.json_line) fmt::print("{}", result_line(job, outcome, code));
  return code;
}

}  // namespace walktrack
