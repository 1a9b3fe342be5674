#include "io/calibration/measured_points.h"

#include <fmt/format.h>

#include "core/dense.h"
#include "core/errors.h"
#include "io/tables/csv.h"

namespace walktrack {
inline namespace io {

namespace {

constexpr size_t kFewestPoints = 4;
constexpr double kLeastBreadth = 0.02;  // extent of the points across their longest line, as a
                                        // share of its length

// Whether the points lie nearly on one line, so that their second singular value is tiny.
bool on_one_line(const std::vector<Eigen::Vector3d>& points) {
  Eigen::MatrixX3d rows(points.size(), 3);
  for (size_t i = 0; i < points.size(); ++i) rows.row(static_cast<Eigen::Index>(i)) = points[i];
  rows.rowwise() -= rows.colwise().mean().eval();
  const Eigen::VectorXd squares = symmetric_eigen(rows.transpose() * rows).values;
  return !(squares[1] > kLeastBreadth * kLeastBreadth * squares[2]);
}

}  // namespace

MeasuredPoints read_measured_points(const std::filesystem::path& path) {
  const CsvTable table = read_csv(path);
  const size_t u = table.column("u"), v = table.column("v");
  const size_t x = table.column("x"), y = table.column("y");
  const auto z = table.find_column("z");
  MeasuredPoints out;
  for (const CsvTable::Row& row : table.rows) {
    out.pixels.emplace_back(table.number(row, u), table.number(row, v));
    out.world.emplace_back(table.number(row, x), table.number(row, y),
                           z ? table.number(row, *z) : 0.0);
    out.lines.push_back(row.line);
  }
  if (out.pixels.size() < kFewestPoints)
    throw InputError(describe(
        {table.file, 0, ""}, fmt::format("{} points", out.pixels.size()),
        fmt::format("at least {}; with eight or more, mistakes can be found", kFewestPoints)));
  if (on_one_line(out.world))
    throw InputError(describe({table.file, 0, ""}, "points that all lie on one line",
                              "points spread over the ground that the camera sees"));
  return out;
}

}  // namespace io
}  // namespace walktrack
