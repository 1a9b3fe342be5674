#include "jobs/batch/subject_table.h"

#include <algorithm>

#include <fmt/format.h>

#include "io/config/text.h"

namespace walktrack {
inline namespace jobs {

namespace fs = std::filesystem;

namespace {

constexpr size_t kMostSubjects = 10'000;

std::string mean_cell(const SubjectSum& sum, size_t figure) {
  const int count = sum.counts[figure];
  return fmt::format(
      "<td class=\"number\">{}</td>",
      count > 0 ? fmt::format("{:.{}f}", sum.sums[figure] / count, kBatchFigures[figure].digits)
                : "");
}

}  // namespace

std::string subject_of(const std::string& name) {
  const fs::path path(name);
  const std::string last = path.filename().string();
  if (last.starts_with("sub-")) return last.substr(0, last.find('_'));
  return path.has_parent_path() ? path.begin()->string() : "";
}

void add_to_subject(const std::string& name, const SequenceResult& result, SubjectSums& sums) {
  const std::string subject = subject_of(name);
  if (subject.empty() || (sums.size() >= kMostSubjects && !sums.contains(subject))) return;
  SubjectSum& sum = sums[subject];
  ++sum.sequences;
  if (result.state != SequenceState::kComplete) return;
  ++sum.complete;
  for (size_t i = 0; i < kBatchFigures.size(); ++i) {
    if (!result.figures[i]) continue;
    sum.sums[i] += *result.figures[i];
    ++sum.counts[i];
  }
}

std::string subjects_html(const SubjectSums& sums) {
  const auto has_two = [](const auto& each) { return each.second.sequences > 1; };
  if (std::none_of(sums.begin(), sums.end(), has_two)) return "";
  std::string text =
      "<h2>Subjects</h2>\n<p class=\"note\">Means over the complete sequences of each, one of a "
      "subject counting as much as another.</p>\n<div class=\"scroll\"><table "
      "id=\"subjects\">\n<thead><tr><th>subject</th><th class=\"number\">sequences</th><th "
      "class=\"number\">complete</th>";
  for (const BatchFigure& figure : kBatchFigures)
    text += fmt::format("<th class=\"number\">{}</th>", figure.heading);
  text += "</tr></thead>\n<tbody>\n";
  for (const auto& [subject, sum] : sums) {
    text += fmt::format(
        "<tr><th scope=\"row\">{}</th><td class=\"number\">{}</td><td class=\"number\">{}</td>",
        html_text(one_line(subject)), sum.sequences, sum.complete);
    for (size_t i = 0; i < kBatchFigures.size(); ++i) text += mean_cell(sum, i);
    text += "</tr>\n";
  }
  return text + "</tbody>\n</table></div>\n<h2>Sequences</h2>\n";
}

}  // namespace jobs
}  // namespace walktrack
