#include "io/keypoints/keypoint_csv.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/errors.h"
#include "io/keypoints/skeleton.h"
#include "io/tables/csv.h"
#include "io/video/image_files.h"

namespace walktrack {
inline namespace io {

namespace {

struct Header {
  std::vector<std::string> individuals, parts, coordinates;  // of each column
  size_t end = 0;                                            // offset in the text
  int rows = 0;
};

[[noreturn]] void fail(const KeypointSource& source, int line, std::string_view found,
                       std::string_view allowed) {
  throw InputError(describe({source.path.string(), line, ""}, found, allowed));
}

Header read_header(const std::string& text, const KeypointSource& source) {
  Header out;
  while (out.coordinates.empty()) {
    const size_t end = std::min(text.find('\n', out.end), text.size());
    std::vector<std::string> cells =
        split_cells(std::string_view(text).substr(out.end, end - out.end));
    ++out.rows;
    out.end = std::min(end + 1, text.size());
    if (cells[0] == "individuals") out.individuals = cells;
    if (cells[0] == "bodyparts") out.parts = cells;
    if (cells[0] == "coords") out.coordinates = cells;
    if (out.end == text.size() || out.rows > 4) break;
  }
  if (out.parts.empty() || out.parts.size() != out.coordinates.size() ||
      (!out.individuals.empty() && out.individuals.size() != out.parts.size()))
    fail(source, 1, "other rows above the numbers",
         "scorer, (individuals,) bodyparts and coords, as DeepLabCut writes them");
  return out;
}

std::string column_name(std::string_view individual, std::string_view part,
                        std::string_view coordinate) {
  return fmt::format("{}/{}/{}", individual, part, coordinate);
}

// The table with one header row; the lines keep their numbers.
CsvTable one_header(const std::string& text, const Header& header, const KeypointSource& source) {
  std::string joined(static_cast<size_t>(header.rows) - 1, '\n');
  joined += "frame";
  for (size_t i = 1; i < header.parts.size(); ++i)
    joined +=
        fmt::format(",{}", column_name(header.individuals.empty() ? "" : header.individuals[i],
                                       header.parts[i], header.coordinates[i]));
  return csv_from_text(joined + "\n" + text.substr(header.end), source.path.string());
}

struct Column {
  KeypointName point;
  size_t x, y, confidence;
};

std::string file_name_of(size_t point, const KeypointSource& source) {
  std::string ours(kKeypointNames[point]);
  if (source.names.empty()) return ours;
  const auto found = source.names.find(ours);
  return found == source.names.end() ? "" : found->second;
}

// A name of the map that is not in the file is an error; a point without a name is not.
std::vector<Column> columns_of(const CsvTable& table, const std::string& individual,
                               const Header& header, const KeypointSource& source) {
  std::vector<Column> out;
  for (size_t point = 0; point < kKeypointCount; ++point) {
    const std::string part = file_name_of(point, source);
    if (part.empty()) continue;
    const bool there =
        std::find(header.parts.begin() + 1, header.parts.end(), part) != header.parts.end();
    if (!there && source.names.empty()) continue;
    if (!there)
      fail(source, header.rows - 1,
           fmt::format("no body part '{}' for {}", part, kKeypointNames[point]),
           fmt::format("the names in the file, such as '{}'", header.parts[1]));
    const auto x = table.find_column(column_name(individual, part, "x"));
    if (!x) continue;  // a column of another individual
    out.push_back({static_cast<KeypointName>(point), *x,
                   table.column(column_name(individual, part, "y")),
                   table.column(column_name(individual, part, "likelihood"))});
  }
  return out;
}

int frame_of_row(const CsvTable& table, const CsvTable::Row& row) {
  const auto frame = last_number_in(std::filesystem::path(row.cells[0]).stem().string());
  if (!frame) table.fail(row, 0, "a frame's number");
  return *frame;
}

std::optional<DetectedPerson> person_of(const CsvTable& table, const CsvTable::Row& row,
                                        const std::vector<Column>& columns) {
  DetectedPerson person;
  bool any = false;
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  for (const Column& column : columns) {
    const auto number = [&](size_t at) { return table.optional_number(row, at).value_or(kNone); };
    person[column.point] =
        keypoint_from(number(column.x), number(column.y), number(column.confidence));
    any = any || person[column.point].confidence > 0;
  }
  if (!any) return std::nullopt;
  return person;
}

}  // namespace

KeypointFrames deeplabcut_table(const std::string& text, const KeypointSource& source) {
  const Header header = read_header(text, source);
  if (header.parts.size() < 2) fail(source, header.rows, "no body part", "columns of numbers");
  const CsvTable table = one_header(text, header, source);
  std::vector<std::string> individuals{""};
  if (!header.individuals.empty()) {
    individuals.assign(header.individuals.begin() + 1, header.individuals.end());
    std::sort(individuals.begin(), individuals.end());
    individuals.erase(std::unique(individuals.begin(), individuals.end()), individuals.end());
  }
  std::vector<std::vector<Column>> columns;
  size_t named = 0;
  for (const std::string& individual : individuals) {
    columns.push_back(columns_of(table, individual, header, source));
    named = std::max(named, columns.back().size());
  }
  if (named == 0)
    fail(source, header.rows - 1,
         fmt::format("body parts of other names, such as '{}'", header.parts[1]),
         "a map in the scene: keypoints: {file: ..., map: {left_knee: its name there, ...}}");
  KeypointFrames out{.format = "DeepLabCut CSV", .points = static_cast<int>(named)};
  for (const CsvTable::Row& row : table.rows) {
    DetectedPeople& people = out.people[frame_of_row(table, row)];
    for (const auto& of_individual : columns)
      if (const auto person = person_of(table, row, of_individual)) people.push_back(*person);
  }
  return out;
}

}  // namespace io
}  // namespace walktrack
