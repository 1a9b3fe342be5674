#include "io/tables/motion_file.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "core/conventions.h"
#include "core/errors.h"
#include "io/tables/csv.h"
#include "io/tables/marker_file.h"

namespace walktrack {
inline namespace io {

namespace {

using Eigen::Vector3d;

constexpr std::array<std::string_view, 3> kAxes{"_x", "_y", "_z"};
constexpr std::array<std::string_view, 3> kStatistics{"_sd", "_p05", "_p95"};

std::string column_name(size_t joint, size_t axis, std::string_view statistic = "") {
  return fmt::format("{}{}{}", kJointNames[joint], kAxes[axis], statistic);
}

// The columns of a joint's three coordinates.
using Triple = std::array<size_t, 3>;

std::optional<Triple> find_triple(const CsvTable& table, size_t joint, std::string_view statistic) {
  Triple triple{};
  size_t found = 0;
  for (size_t axis = 0; axis < 3; ++axis) {
    if (const auto column = table.find_column(column_name(joint, axis, statistic))) {
      triple[axis] = *column;
      ++found;
    }
  }
  if (found == 0) return std::nullopt;
  if (found < 3) {
    for (size_t axis = 0; axis < 3; ++axis) table.column(column_name(joint, axis, statistic));
  }
  return triple;
}

// The name in front of "_x", "_y", "_z"; "" for other columns.
std::string joint_of_column(const std::string& column) {
  for (const std::string_view axis : kAxes) {
    if (column.ends_with(axis)) return column.substr(0, column.size() - axis.size());
  }
  return "";
}

// Unknown groups of three columns are ignored; misspelt names are an error.
void check_columns(const CsvTable& table) {
  const std::vector<std::string> known(kJointNames.begin(), kJointNames.end());
  for (const std::string& column : table.columns) {
    const std::string joint = joint_of_column(column);
    if (column == "t" || std::find(known.begin(), known.end(), joint) != known.end()) continue;
    const std::string nearest = nearest_word(joint, known);
    if (!joint.empty() && nearest.empty()) continue;
    throw InputError(describe(
        {table.file, table.header_line, ""}, fmt::format("column '{}'", column),
        nearest.empty() ? "t and <joint>_x, _y, _z" : fmt::format("'{}' is nearest", nearest)));
  }
}

std::vector<double> read_times(const CsvTable& table) {
  const size_t column = table.column("t");
  std::vector<double> times;
  for (const CsvTable::Row& row : table.rows) {
    times.push_back(table.number(row, column));
    if (times.size() > 1 && !(times.back() > times[times.size() - 2])) {
      table.fail(row, column, "times that increase");
    }
  }
  return times;
}

// The joints of all rows in the file's axes; joints without columns are unknown.
std::vector<JointPositions> read_joints(const CsvTable& table, std::string_view statistic) {
  std::vector<JointPositions> rows(table.rows.size(), unknown_joints());
  for (size_t joint = 0; joint < kJointCount; ++joint) {
    const auto triple = find_triple(table, joint, statistic);
    if (!triple) continue;
    for (size_t i = 0; i < rows.size(); ++i) {
      for (size_t axis = 0; axis < 3; ++axis) {
        rows[i].at[joint][static_cast<Eigen::Index>(axis)] =
            table.optional_number(table.rows[i], (*triple)[axis]).value_or(kUnknown);
      }
    }
  }
  return rows;
}

void append_cells(std::string& text, const Vector3d& values) {
  for (const double value : values) append_number(text, ',', value);
}

struct AxisSpread {
  double sd, p05, p95;
};

// The spread along the calibration axis `axis` of a point that has the standard deviations `sd`
// along the world's axes, and percentiles at the distances `below` and `above` from the mean.
AxisSpread turned_spread(const WorldFrame& world, Eigen::Index axis, double mean,
                         const Vector3d& sd, const Vector3d& below, const Vector3d& above) {
  const Vector3d share = world.rotation.col(axis);  // of each world axis in this calibration axis
  const Vector3d low = (share.array() > 0).select(below, above);
  const Vector3d high = (share.array() > 0).select(above, below);
  return {share.cwiseProduct(sd).norm(), mean - share.cwiseProduct(low).norm(),
          mean + share.cwiseProduct(high).norm()};
}

}  // namespace

int listed_joint_count(const Motion& motion) {
  for (const JointPositions& joints : motion.joints) {
    for (size_t joint = kJointCountWithoutArms; joint < kJointCount; ++joint) {
      if (known(joints.at[joint])) return kJointCount;
    }
  }
  return kJointCountWithoutArms;
}

Motion read_motion(const std::filesystem::path& path, const WorldFrame& world) {
  if (is_marker_file(path)) return read_marker_motion(path);
  const CsvTable table = read_csv(path);
  check_columns(table);
  Motion motion{read_times(table), read_joints(table, "")};
  for (JointPositions& joints : motion.joints) {
    for (Vector3d& point : joints.at) point = world_from_calibration(world, point);
  }
  return motion;
}

std::string motion_csv(const Motion& motion, const WorldFrame& world) {
  const auto count = static_cast<size_t>(listed_joint_count(motion));
  std::string text = "t";
  for (size_t joint = 0; joint < count; ++joint) {
    for (size_t axis = 0; axis < 3; ++axis) text += fmt::format(",{}", column_name(joint, axis));
  }
  text += "\n";
  for (size_t i = 0; i < motion.time.size(); ++i) {
    text += csv_number(motion.time[i]);
    for (size_t joint = 0; joint < count; ++joint) {
      append_cells(text, calibration_from_world(world, motion.joints[i].at[joint]));
    }
    text += "\n";
  }
  return text;
}

std::string uncertainty_csv(const Motion& motion, const JointUncertainty& uncertainty,
                            const WorldFrame& world) {
  const auto count = static_cast<size_t>(listed_joint_count(motion));
  std::string text = "t";
  for (size_t joint = 0; joint < count; ++joint) {
    for (size_t axis = 0; axis < 3; ++axis) {
      for (const std::string_view what : kStatistics) {
        text += fmt::format(",{}", column_name(joint, axis, what));
      }
    }
  }
  text += "\n";
  for (size_t i = 0; i < uncertainty.time.size(); ++i) {
    text += csv_number(uncertainty.time[i]);
    for (size_t joint = 0; joint < count; ++joint) {
      const Vector3d& mean = motion.joints[i].at[joint];
      const Vector3d mean_calibration = calibration_from_world(world, mean);
      for (Eigen::Index axis = 0; axis < 3; ++axis) {
        const AxisSpread spread =
            turned_spread(world, axis, mean_calibration[axis], uncertainty.sd[i].at[joint],
                          mean - uncertainty.p05[i].at[joint], uncertainty.p95[i].at[joint] - mean);
        append_cells(text, {spread.sd, spread.p05, spread.p95});
      }
    }
    text += "\n";
  }
  return text;
}

JointUncertainty read_uncertainty(const std::filesystem::path& path) {
  const CsvTable table = read_csv(path);
  return {read_times(table), read_joints(table, kStatistics[0]), read_joints(table, kStatistics[1]),
          read_joints(table, kStatistics[2])};
}

}  // namespace io
}  // namespace walktrack
