// walktrack batch: every sequence below a folder.
#include <filesystem>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "commands.h"
#include "core/errors.h"
#include "core/parallel_for.h"
#include "jobs/batch/batch.h"
#include "jobs/batch/batch_changes.h"
#include "jobs/batch/shard.h"
#include "terminal.h"

namespace walktrack {

namespace po = boost::program_options;

namespace {

// This program tracking one sequence, with the options that it was given itself.
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
  for (const Sequence& sequence : shard_of(sequences_of(job), job.shard, job.shards)) {
    fmt::print("{}\t{}\n", state_name(result_of(sequence).state), sequence.name);
  }
  return kDone;
}

int list_work(const BatchJob& job) {
  for (const Sequence& sequence : work_of(job).to_do) fmt::print("{}\n", sequence.name);
  return kDone;
}

int exit_code(const BatchOutcome& outcome) {
  if (outcome.interrupted || stop_request()) return kInterrupted;
  if (outcome.failed + outcome.waiting > 0) return kFailed;
  return outcome.degraded > 0 ? kDegraded : kDone;
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
                                       {"waiting", outcome.waiting}};
  return line.dump(-1, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
}

// What the whole output folder holds by now, whoever did it.
int report(const BatchJob& job) {
  const std::vector<Sequence> all = sequences_of(job);
  write_batch_reports(all, batch_outputs(job));
  bool all_well = true;
  for (const Sequence& sequence : all) {
    const SequenceState state = result_of(sequence).state;
    all_well = all_well && state == SequenceState::kComplete;
  }
  return all_well ? kDone : kFailed;
}

}  // namespace

int run_batch(const Arguments& arguments) {
  BatchJob job;
  std::string folder, scene_template, shard = "1/1";
  bool list_only = false, dry_run = false, report_only = false, resume = false;
  bool ignore_checks = false, json_line = false;
  CommandLine line({.name = "batch",
                    .operands = "FOLDER",
                    .about =
                        "Tracks every scene below FOLDER, each in a process of its own; goes "
                        "on after failures.\nRun again, it does what is not complete, from where "
                        "it was killed (--resume,\nthe default); with -y also sequences of other "
                        "settings or inputs. Several machines\nmay share one output folder.",
                    .example = "walktrack batch data -o out/batch --jobs 2"});
  line.options().add_options()("scene", po::value(&scene_template)->value_name("FILE"),
                               "take every video below FOLDER in the place of this scene\'s video")(
      "jobs,j", po::value(&job.jobs)->default_value(1)->value_name("N"),
      "number of sequences at a time")("shard", po::value(&shard)->value_name("i/n"),
                                       "do every n-th sequence, from the i-th; auto: as Slurm or "
                                       "AWS Batch number this worker, auto/n: "
                                       "as a Kubernetes Indexed Job of n does")(
      "time-limit", po::value(&job.limits.seconds)->value_name("S"), "time of one sequence")(
      "memory-limit", po::value(&job.limits.memory_mb)->value_name("MB"), "memory of one sequence")(
      "resume", po::bool_switch(&resume),
      "skip complete sequences and continue from checkpoints; the default, so it only forbids "
      "--yes")("list", po::bool_switch(&list_only),
               "print the sequences and their state, do nothing")(
      "retry-failed", po::bool_switch(&job.retry_failed),
      "do only the sequences that failed before")(
      "dry-run", po::bool_switch(&dry_run), "print the sequences that would be done, do nothing")(
      "ignore-checks", po::bool_switch(&ignore_checks),
      "track scenes though their checks fail (see walktrack check); their reports say so")(
      "report", po::bool_switch(&report_only), "write only the summary of the existing results")(
      "json-line", po::bool_switch(&json_line),
      "print the number of sequences by outcome, or the error, as one line of JSON");
  line.operand("FOLDER", &folder);
  if (!line.parse(arguments)) return kDone;
  if (job.jobs < 1) throw UsageError("--jobs: found less than 1, allowed: from 1");
  if (resume && line.common().overwrite) {
    throw UsageError(
        "--resume and --yes exclude each other: what has changed is left as it is or done again");
  }
  const Shard share = shard_from(shard, process_environment());
  job.shard = share.index;
  job.shards = share.count;
  job.folder = folder;
  job.scene_template = scene_template;
  job.output = line.required_output();
  job.overwrite = line.common().overwrite;
  if (list_only) return list(job);
  if (report_only) return report(job);
  job.config = line.config();  // a mistake in it would fail every sequence
  if (dry_run) return list_work(job);
  job.command = track_command(line.common(), job.jobs, ignore_checks);
  Terminal terminal(line.common());
  const JobControl control = terminal.control();
  const BatchOutcome outcome = run_batch(job, control);
  control.say(fmt::format("{} complete, {} degraded, {} failed, {} left; see {}", outcome.complete,
                          outcome.degraded, outcome.failed, outcome.waiting,
                          (job.output / "batch.html").string()));
  if (outcome.changed > 0 && !outcome.interrupted) {
    throw UsageError(fmt::format(
        "{} sequences are left as they are, for they are of other settings or inputs; -y does them "
        "again{}",
        outcome.changed, outcome.changes));
  }
  const int code = exit_code(outcome);
  if (json_line) fmt::print("{}", result_line(job, outcome, code));
  return code;
}

}  // namespace walktrack
