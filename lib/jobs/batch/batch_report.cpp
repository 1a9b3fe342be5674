#include "jobs/batch/batch_report.h"

#include <array>
#include <chrono>
#include <thread>

#include <fmt/format.h>

#include "io/archive/files.h"
#include "io/config/text.h"
#include "io/drawing/report_page.h"
#include "jobs/batch/bids/bids_report.h"
#include "jobs/batch/subject_table.h"
#include "jobs/batch/workers/folder_lock.h"
#include "jobs/batch/workers/sequence_claim.h"

namespace walktrack {
inline namespace jobs {

namespace {

std::string number(const std::optional<double>& value, int digits) {
  return value ? fmt::format("{:.{}f}", *value, digits) : "";
}

// A page cannot show a million rows.
constexpr size_t kMostRowsOfPage = 10'000;

std::string summary_heading() {
  std::string text = "sequence,state,seconds,digest,reason";
  for (const BatchFigure& figure : kBatchFigures) text += fmt::format(",{}", figure.column);
  return text + ",cpu_seconds_per_video_second\n";
}

std::optional<double> cost_of(const SequenceResult& result) {
  return result.video_seconds > 0 ? std::optional(result.cpu_seconds / result.video_seconds)
                                  : std::nullopt;
}

std::string summary_row(const Sequence& sequence, const SequenceResult& result) {
  std::string text =
      fmt::format("{},{},{},{},{}", csv_cell(sequence.name), state_name(result.state),
                  result.seconds > 0 ? fmt::format("{:.1f}", result.seconds) : "",
                  csv_cell(result.digest), csv_cell(result.reason));
  for (const auto& figure : result.figures) text += fmt::format(",{}", number(figure, 6));
  return text + fmt::format(",{}\n", number(cost_of(result), 2));
}

std::string headings_html() {
  std::string row = "<th>sequence</th><th>state</th>";
  for (const BatchFigure& figure : kBatchFigures)
    row += fmt::format("<th class=\"number\">{}</th>", figure.heading);
  return row +
         "<th class=\"number\">time, s</th>"
         "<th class=\"number\" title=\"CPU seconds for a second of video\">CPU s/s</th>";
}

// The page to open: the report, otherwise the folder.
std::string link_to(const Sequence& sequence) {
  std::error_code ignored;
  const bool report = std::filesystem::is_regular_file(sequence.output / "report.html", ignored);
  return url_path(sequence.name) + (report ? "/report.html" : "/");
}

std::string row_html(const Sequence& sequence, const SequenceResult& result) {
  const std::string_view state = state_name(result.state);
  std::string row =
      fmt::format("<tr><th scope=\"row\"><a href=\"{}\">{}</a></th><td class=\"{}\">{}",
                  link_to(sequence), html_text(one_line(sequence.name)), state, state);
  if (!result.reason.empty())
    row += fmt::format("<small>{}</small>", html_text(one_line(result.reason)));
  row += "</td>";
  for (size_t i = 0; i < kBatchFigures.size(); ++i)
    row += fmt::format("<td class=\"number\">{}</td>",
                       number(result.figures[i], kBatchFigures[i].digits));
  return row + fmt::format("<td class=\"number\">{}</td><td class=\"number\">{}</td></tr>\n",
                           result.seconds > 0 ? fmt::format("{:.1f}", result.seconds) : "",
                           number(cost_of(result), 1));
}

std::string states_html(const BatchOutcome& counts) {
  std::string tiles;
  const auto add = [&](SequenceState state, int count) {
    tiles +=
        fmt::format("<li><b class=\"{0}\">{1}</b><span>{0}</span></li>", state_name(state), count);
  };
  add(SequenceState::kComplete, counts.complete);
  add(SequenceState::kDegraded, counts.degraded);
  add(SequenceState::kFailed, counts.failed);
  add(SequenceState::kWaiting, counts.waiting);
  return tiles;
}

// The template with its marks replaced by texts, in the order in which they appear.
std::string filled(std::string_view page,
                   std::initializer_list<std::pair<std::string_view, std::string>> texts) {
  std::string out;
  for (const auto& [mark, text] : texts) {
    const size_t place = page.find(mark);
    out.append(page.substr(0, place)).append(text);
    page.remove_prefix(place + mark.size());
  }
  return out.append(page);
}

std::string headline(const BatchOutcome& counts, size_t sequences) {
  std::string text = fmt::format("{} of {} sequences complete", counts.complete, sequences);
  if (sequences > kMostRowsOfPage)
    text += fmt::format("; the first {} of summary.csv are here", kMostRowsOfPage);
  return text;
}

// Only one process writes at a time, so that the holder of the lock may remove what a killed one
// has left.
FolderLock lock_of(const std::filesystem::path& folder) {
  for (;;) {
    if (auto claim = FolderLock::try_take(folder)) return std::move(*claim);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

constexpr std::array<std::string_view, 3> kReports{"summary.csv", "failures.txt", "batch.html"};

}  // namespace

void add_result(const Sequence& sequence, const SequenceResult& result, BatchOutcome& out) {
  out.complete += result.state == SequenceState::kComplete;
  out.degraded += result.state == SequenceState::kDegraded;
  out.failed += result.state == SequenceState::kFailed;
  if (result.state == SequenceState::kWaiting) {
    ++out.waiting;
    out.elsewhere += is_claimed(sequence.output);
  }
  out.cpu_seconds += result.cpu_seconds;
  out.video_seconds += result.video_seconds;
}

Outputs batch_outputs(const BatchJob& job) {
  // Scenes are found below their folder, so that their folder cannot be the output folder as well.
  Outputs out{job.output, "batch", {kReports.begin(), kReports.end()}, {}, ""};
  if (job.manifest.empty()) out.inputs.push_back(job.folder);
  if (job.bids) out.files.emplace_back(kBidsDescription);
  if (!job.manifest.empty() && job.manifest != "-") out.inputs.emplace_back(job.manifest);
  return out;
}

BatchOutcome write_batch_reports(const BatchJob& job, const SequenceList& list) {
  const Outputs outputs = batch_outputs(job);
  refuse_what_is_not_ours(outputs);
  if (!std::filesystem::is_directory(outputs.folder))
    throw InputError(describe({outputs.folder.string(), 0, ""}, "no folder",
                              "the output folder of a batch that has begun"));
  const FolderLock claim = lock_of(outputs.folder);
  // Reports are replaced and never removed first, because others may be reading them.
  const std::vector<std::string_view> kept(outputs.files.begin(), outputs.files.end());
  const ResultFolder folder(outputs, true, kept);
  AtomicFile summary(folder.file("summary.csv")), failures(folder.file("failures.txt"));
  summary.write(summary_heading());
  BatchOutcome counts;
  std::string rows;
  SubjectSums subjects;
  size_t shown = 0;
  auto all = list.sequences(SequenceList::Share::kAll);
  while (const auto sequence = all.next()) {
    const SequenceResult result = result_of(*sequence);
    add_result(*sequence, result, counts);
    add_to_subject(sequence->name, result, subjects);
    summary.write(summary_row(*sequence, result));
    if (result.state == SequenceState::kFailed)
      failures.write(fmt::format("{}: {}\n", one_line(sequence->name), one_line(result.reason)));
    if (shown++ < kMostRowsOfPage) rows += row_html(*sequence, result);
  }
  summary.commit();
  failures.commit();
  folder.write("batch.html",
               filled(batch_template(), {{"<!--HEADLINE-->", headline(counts, list.size())},
                                         {"<!--STATES-->", states_html(counts)},
                                         {"<!--SUBJECTS-->", subjects_html(subjects)},
                                         {"<!--HEADINGS-->", headings_html()},
                                         {"<!--ROWS-->\n", rows}}));
  if (job.bids) write_bids(job, list, folder);
  return counts;
}

}  // namespace jobs
}  // namespace walktrack
