#include <algorithm>
#include <array>
#include <chrono>
#include <thread>

#include <fmt/format.h>

#include "io/config/text.h"
#include "io/drawing/report_page.h"
#include "jobs/batch/batch.h"
#include "jobs/batch/folder_lock.h"

namespace walktrack {

namespace {

std::string number(const std::optional<double>& value, int digits) {
  return value ? fmt::format("{:.{}f}", *value, digits) : "";
}

std::string summary_csv(const std::vector<Sequence>& sequences,
                        const std::vector<SequenceResult>& results) {
  std::string text = "sequence,state,seconds,digest,reason";
  for (const BatchFigure& figure : kBatchFigures) text += fmt::format(",{}", figure.column);
  text += "\n";
  for (size_t i = 0; i < sequences.size(); ++i) {
    const SequenceResult& result = results[i];
    text += fmt::format("{},{},{},{},{}", csv_cell(sequences[i].name), state_name(result.state),
                        result.seconds > 0 ? fmt::format("{:.1f}", result.seconds) : "",
                        csv_cell(result.digest), csv_cell(result.reason));
    for (const auto& figure : result.figures) text += fmt::format(",{}", number(figure, 6));
    text += "\n";
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

std::string headings_html() {
  std::string row = "<th>sequence</th><th>state</th>";
  for (const BatchFigure& figure : kBatchFigures)
    row += fmt::format("<th class=\"number\">{}</th>", figure.heading);
  return row + "<th class=\"number\">time, s</th>";
}

// What to look at: the report, else the folder.
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
  return row + fmt::format("<td class=\"number\">{}</td></tr>\n",
                           result.seconds > 0 ? fmt::format("{:.1f}", result.seconds) : "");
}

std::string states_html(const std::vector<SequenceResult>& results) {
  std::string tiles;
  for (const SequenceState state : {SequenceState::kComplete, SequenceState::kDegraded,
                                    SequenceState::kFailed, SequenceState::kWaiting}) {
    const auto count = std::count_if(results.begin(), results.end(),
                                     [&](const auto& result) { return result.state == state; });
    tiles +=
        fmt::format("<li><b class=\"{0}\">{1}</b><span>{0}</span></li>", state_name(state), count);
  }
  return tiles;
}

// The template with texts in the place of its marks, which stand there in this order.
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

std::string overview_html(const std::vector<Sequence>& sequences,
                          const std::vector<SequenceResult>& results) {
  int complete = 0;
  std::string rows;
  for (size_t i = 0; i < sequences.size(); ++i) {
    complete += results[i].state == SequenceState::kComplete;
    rows += row_html(sequences[i], results[i]);
  }
  return filled(
      batch_template(),
      {{"<!--HEADLINE-->", fmt::format("{} of {} sequences complete", complete, sequences.size())},
       {"<!--STATES-->", states_html(results)},
       {"<!--HEADINGS-->", headings_html()},
       {"<!--ROWS-->\n", rows}});
}

// One writer at a time: whoever holds the folder may clear what one that was killed has left.
FolderLock lock_of(const std::filesystem::path& folder) {
  for (;;) {
    if (auto claim = FolderLock::try_take(folder)) return std::move(*claim);
    std::this_thread::sleep_for(std::chrono::milliseconds(50));
  }
}

constexpr std::array<std::string_view, 3> kReports{"summary.csv", "failures.txt", "batch.html"};

}  // namespace

Outputs batch_outputs(const BatchJob& job) {
  // Scenes are found below their folder: as the output folder it would hold them.
  return {job.output, "batch", {kReports.begin(), kReports.end()}, {job.folder}, ""};
}

void write_batch_reports(const std::vector<Sequence>& sequences, const Outputs& outputs) {
  refuse_what_is_not_ours(outputs);
  const FolderLock claim = lock_of(outputs.folder);
  // Others may read the reports: they are replaced, never missing.
  const ResultFolder folder(outputs, true, kReports);
  std::vector<SequenceResult> results;
  for (const Sequence& sequence : sequences) results.push_back(result_of(sequence));
  folder.write("summary.csv", summary_csv(sequences, results));
  folder.write("failures.txt", failures_txt(sequences, results));
  folder.write("batch.html", overview_html(sequences, results));
}

}  // namespace walktrack
