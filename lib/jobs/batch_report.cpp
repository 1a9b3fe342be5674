#include <fmt/format.h>

#include "io/files.h"
#include "io/text.h"
#include "jobs/batch.h"

namespace walktrack {

namespace {

std::string summary_csv(const std::vector<Sequence>& sequences,
                        const std::vector<SequenceResult>& results) {
  std::string text = "sequence,state,seconds,digest,reason\n";
  for (size_t i = 0; i < sequences.size(); ++i) {
    const SequenceResult& result = results[i];
    text += fmt::format("{},{},{},{},{}\n", csv_cell(sequences[i].name), state_name(result.state),
                        result.seconds > 0 ? fmt::format("{:.1f}", result.seconds) : "",
                        csv_cell(result.digest), csv_cell(result.reason));
  }
  return text;
}

std::string failures_txt(const std::vector<Sequence>& sequences,
                         const std::vector<SequenceResult>& results) {
  std::string text;
  for (size_t i = 0; i < sequences.size(); ++i) {
    if (results[i].state != SequenceState::kFailed) continue;
    text += fmt::format("{}: {}\n", one_line(sequences[i].name), one_line(results[i].reason));
  }
  return text;
}

constexpr const char* kPageStart =
    "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>walktrack batch"
    "</title>\n<style>body{font-family:sans-serif;margin:2em}td,th{padding:.3em .8em;"
    "text-align:left;border-bottom:1px solid #ccc}.failed{color:#b00020}.degraded{color:#8a5a00}"
    "</style></head><body>\n<h1>Batch</h1>\n";

std::string overview_html(const std::vector<Sequence>& sequences,
                          const std::vector<SequenceResult>& results) {
  int complete = 0;
  std::string rows;
  for (size_t i = 0; i < sequences.size(); ++i) {
    const SequenceResult& result = results[i];
    complete += result.state == SequenceState::kComplete;
    const std::string name = html_text(sequences[i].name);
    rows += fmt::format(
        "<tr><td><a href=\"{}/\">{}</a></td><td class=\"{}\">{}</td><td>{}</td><td>{}</td></tr>\n",
        url_path(sequences[i].name), name, state_name(result.state), state_name(result.state),
        result.seconds > 0 ? fmt::format("{:.1f} s", result.seconds) : "",
        html_text(result.reason));
  }
  return fmt::format(
      "{}<p>{} of {} sequences complete</p>\n<table><tr><th>sequence</th><th>state</th>"
      "<th>time</th><th>reason</th></tr>\n{}</table></body></html>\n",
      kPageStart, complete, sequences.size(), rows);
}

}  // namespace

void write_batch_reports(const std::vector<Sequence>& sequences,
                         const std::filesystem::path& output) {
  std::vector<SequenceResult> results;
  for (const Sequence& sequence : sequences) results.push_back(result_of(sequence));
  write_file_atomically(output / "summary.csv", summary_csv(sequences, results));
  write_file_atomically(output / "failures.txt", failures_txt(sequences, results));
  write_file_atomically(output / "batch.html", overview_html(sequences, results));
}

}  // namespace walktrack
