#include "io/tables/csv.h"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <limits>
#include <set>
#include <string_view>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/archive/files.h"

namespace walktrack {
inline namespace io {

namespace {

std::string trimmed(std::string_view text) {
  constexpr std::string_view kBlanks = " \t\r";
  const size_t first = text.find_first_not_of(kBlanks);
  if (first == std::string_view::npos) return "";
  return std::string(text.substr(first, text.find_last_not_of(kBlanks) - first + 1));
}

void take_header(CsvTable& table, std::vector<std::string> columns, int line) {
  const std::set<std::string> distinct(columns.begin(), columns.end());
  if (distinct.size() != columns.size()) {
    throw InputError(describe({table.file, line, ""}, "a column twice", "names of their own"));
  }
  table.columns = std::move(columns);
  table.header_line = line;
}

void take_row(CsvTable& table, std::vector<std::string> cells, int line) {
  if (cells.size() != table.columns.size()) {
    throw InputError(describe({table.file, line, ""}, fmt::format("{} cells", cells.size()),
                              fmt::format("{}, as in the header", table.columns.size())));
  }
  table.rows.push_back({line, std::move(cells)});
}

}  // namespace

std::vector<std::string> split_cells(std::string_view line) {
  std::vector<std::string> cells;
  for (size_t at = 0;;) {
    const size_t comma = line.find(',', at);
    cells.push_back(trimmed(line.substr(at, comma - at)));
    if (comma == std::string_view::npos) return cells;
    at = comma + 1;
  }
}

std::optional<size_t> CsvTable::find_column(const std::string& name) const {
  const auto found = std::find(columns.begin(), columns.end(), name);
  if (found == columns.end()) return std::nullopt;
  return static_cast<size_t>(found - columns.begin());
}

size_t CsvTable::column(const std::string& name) const {
  if (const auto found = find_column(name)) return *found;
  const std::string nearest = nearest_word(name, columns);
  throw InputError(describe({file, header_line, ""}, fmt::format("no column '{}'", name),
                            nearest.empty() ? "" : fmt::format("it; is '{}' meant?", nearest)));
}

void CsvTable::fail(const Row& row, size_t column, const std::string& allowed) const {
  throw InputError(
      describe({file, row.line, columns[column]}, fmt::format("'{}'", row.cells[column]), allowed));
}

std::optional<double> CsvTable::optional_number(const Row& row, size_t column) const {
  if (row.cells[column].empty()) return std::nullopt;
  return number(row, column);
}

double CsvTable::number(const Row& row, size_t column) const {
  const auto value = number_from_text(row.cells[column]);
  if (!value) fail(row, column, "a number");
  return *value;
}

std::vector<std::vector<double>> read_csv_columns(const std::filesystem::path& path,
                                                  const std::vector<std::string>& names) {
  std::ifstream stream(path, std::ios::binary);
  if (!stream) throw InputError(fmt::format("{}: cannot be opened", path.string()));
  CsvTable table;  // the header, and one row at a time
  table.file = path.string();
  std::vector<size_t> wanted;
  std::vector<std::vector<double>> columns(names.size());
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    if (trimmed(line).empty() || line.front() == '#') continue;
    if (table.columns.empty()) {
      take_header(table, split_cells(line), number);
      for (const std::string& name : names) wanted.push_back(table.column(name));
      continue;
    }
    table.rows.clear();
    take_row(table, split_cells(line), number);
    for (size_t k = 0; k < wanted.size(); ++k) {
      columns[k].push_back(table.optional_number(table.rows.front(), wanted[k])
                               .value_or(std::numeric_limits<double>::quiet_NaN()));
    }
  }
  if (table.columns.empty()) throw InputError(fmt::format("{}: no header", path.string()));
  return columns;
}

CsvTable csv_from_text(const std::string& text, const std::string& file) {
  CsvTable table;
  table.file = file;
  int line_number = 0;
  for (size_t at = 0; at < text.size();) {
    const size_t end = std::min(text.find('\n', at), text.size());
    const std::string_view line = std::string_view(text).substr(at, end - at);
    at = end + 1;
    ++line_number;
    if (trimmed(line).empty() || line[0] == '#') continue;
    if (table.columns.empty()) {
      take_header(table, split_cells(line), line_number);
    } else {
      take_row(table, split_cells(line), line_number);
    }
  }
  if (table.columns.empty()) throw InputError(describe({file, 0, ""}, "no header line", ""));
  return table;
}

CsvTable read_csv(const std::filesystem::path& path) {
  return csv_from_text(read_text_file(path, kMaxCsvBytes), path.string());
}

std::string csv_number(double value) {
  if (std::isnan(value)) return "";
  std::string text = fmt::format("{:.6f}", value);
  if (text == "-0.000000") text.erase(0, 1);
  return text;
}

void append_number(std::string& text, char separator, double value) {
  text += separator;
  text += csv_number(value);
}

}  // namespace io
}  // namespace walktrack
