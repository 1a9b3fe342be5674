// Text tables: a header line, then one row per line, with cells separated by commas. Empty lines
// and lines that start with '#' are ignored. There is no quoting: cells contain numbers and words.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace walktrack {
inline namespace io {

struct CsvTable {
  struct Row {
    int line;  // line number in the file, from 1
    std::vector<std::string> cells;
  };
  std::string file;  // name in messages
  int header_line = 0;
  std::vector<std::string> columns;
  std::vector<Row> rows;  // each with as many cells as there are columns

  std::optional<size_t> find_column(const std::string& name) const;
  // Throws an InputError that names the nearest column if it is missing.
  size_t column(const std::string& name) const;
  // An empty cell is nullopt; a cell that is not a finite number is an InputError.
  std::optional<double> optional_number(const Row& row, size_t column) const;
  // An empty cell is an InputError, too.
  double number(const Row& row, size_t column) const;
  // Throws the InputError for a cell.
  [[noreturn]] void fail(const Row& row, size_t column, const std::string& allowed) const;
};

// Throws an InputError for a file without header, duplicate columns, or a row of another length.
CsvTable read_csv(const std::filesystem::path& path);
// Reads some columns of a long table without storing the rest: one list of numbers for each name,
// NaN for empty cells. Errors are those of read_csv.
std::vector<std::vector<double>> read_csv_columns(const std::filesystem::path& path,
                                                  const std::vector<std::string>& names);
CsvTable csv_from_text(const std::string& text, const std::string& file);

// A line's cells without surrounding white space; at least one.
std::vector<std::string> split_cells(std::string_view line);

// A number with six decimals (µm, µs), as in all tables; "" for NaN, never "-0.000000".
std::string csv_number(double value);

// Appends the separator, then the number.
void append_number(std::string& text, char separator, double value);

inline constexpr size_t kMaxCsvBytes = size_t{1} << 30;

}  // namespace io
}  // namespace walktrack
