#include "io/tables/trc_read.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/conventions.h"
#include "core/errors.h"
#include "io/archive/files.h"

namespace walktrack {
inline namespace io {

namespace {

struct Line {
  int number;
  std::vector<std::string> cells;
};

std::vector<std::string> cells_of(std::string_view line) {
  std::vector<std::string> cells;
  while (true) {
    const size_t tab = line.find('\t');
    std::string cell(line.substr(0, tab));
    const size_t first = cell.find_first_not_of(" \r"), last = cell.find_last_not_of(" \r");
    cells.push_back(first == std::string::npos ? "" : cell.substr(first, last - first + 1));
    if (tab == std::string_view::npos) return cells;
    line.remove_prefix(tab + 1);
  }
}

std::vector<Line> lines_of(std::string_view text) {
  std::vector<Line> lines;
  for (int number = 1; !text.empty(); ++number) {
    const size_t end = text.find('\n');
    lines.push_back({number, cells_of(text.substr(0, end))});
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
  }
  return lines;
}

[[noreturn]] void fail(const std::string& file, int line, const std::string& found,
                       const std::string& allowed) {
  throw InputError(describe({file, line, ""}, found, allowed));
}

double metres_per(const std::string& file, const std::vector<Line>& lines) {
  for (size_t i = 0; i < lines[1].cells.size() && i < lines[2].cells.size(); ++i) {
    if (lines[1].cells[i] != "Units") continue;
    const std::string& unit = lines[2].cells[i];
    if (unit == "m") return 1;
    if (unit == "mm") return 1e-3;
    if (unit == "cm") return 1e-2;
    fail(file, 3, fmt::format("the unit '{}'", unit), "m, cm or mm");
  }
  fail(file, 2, "no Units", "a TRC file's heading: DataRate, ..., Units, ...");
}

double number_of(const std::string& file, const Line& line, size_t cell) {
  if (cell >= line.cells.size() || line.cells[cell].empty()) return kUnknown;
  const std::string& text = line.cells[cell];
  if (text == "nan" || text == "NaN" || text == "NAN") return kUnknown;
  const auto value = number_from_text(text);
  if (!value) fail(file, line.number, fmt::format("'{}'", text), "a number or an empty cell");
  return *value;
}

bool blank(const Line& line) {
  return std::all_of(line.cells.begin(), line.cells.end(),
                     [](const std::string& cell) { return cell.empty(); });
}

}  // namespace

MarkerTable markers_from_trc(std::string_view text, const std::string& file) {
  const std::vector<Line> lines = lines_of(text);
  if (lines.size() < 6 || lines[0].cells[0] != "PathFileType")
    fail(file, 1, "another heading", "a TRC file, which begins with PathFileType");
  const double metres = metres_per(file, lines);
  const std::vector<std::string>& heads = lines[3].cells;
  if (heads.size() < 3 || heads[0] != "Frame#" || heads[1] != "Time")
    fail(file, 4, fmt::format("'{}'", heads[0]), "Frame#, Time and the points' names");
  MarkerTable out{file, {}, {}, {}};
  std::vector<size_t> columns;
  for (size_t i = 2; i < heads.size(); ++i) {
    if (heads[i].empty()) continue;
    out.names.push_back(heads[i]);
    columns.push_back(i);
  }
  for (size_t i = 5; i < lines.size(); ++i) {
    if (blank(lines[i])) continue;
    out.time.push_back(number_of(file, lines[i], 1));
    const size_t n = out.time.size();
    if (!std::isfinite(out.time.back()) || (n > 1 && !(out.time[n - 1] > out.time[n - 2])))
      fail(file, lines[i].number,
           "the time " + lines[i].cells[std::min<size_t>(1, lines[i].cells.size() - 1)],
           "times that increase");
    auto& row = out.points.emplace_back();
    for (const size_t column : columns)
      row.emplace_back(metres * number_of(file, lines[i], column),
                       metres * number_of(file, lines[i], column + 1),
                       metres * number_of(file, lines[i], column + 2));
  }
  return out;
}

}  // namespace io
}  // namespace walktrack
