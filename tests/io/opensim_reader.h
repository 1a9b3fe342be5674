// Files for OpenSim as OpenSim reads them, and the model that it would show.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include "body/subject.h"
#include "core/conventions.h"
#include "core/errors.h"

namespace walktrack {

inline std::vector<std::string> split(const std::string& text, char at) {
  std::vector<std::string> parts;
  std::istringstream stream(text);
  for (std::string part; std::getline(stream, part, at);) parts.push_back(part);
  return parts;
}

// Splits a line as OpenSim does: at every tab; what follows the last tab is a cell if it is not
// empty.
inline std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  size_t at = 0;
  for (size_t tab = 0; (tab = line.find('\t', at)) != std::string::npos; at = tab + 1)
    cells.push_back(line.substr(at, tab - at));
  if (at < line.size()) cells.push_back(line.substr(at));
  return cells;
}

inline std::vector<std::string> without_empty(std::vector<std::string> cells) {
  std::erase(cells, "");
  return cells;
}

struct Markers {
  std::vector<std::string> names;
  std::vector<double> time;
  std::vector<std::vector<Eigen::Vector3d>> rows;  // NaN = missing
};

// A .trc as OpenSim 4 reads it (TRCFileAdapter): eight keys with a value each; as many names as
// NumMarkers; X1, Y1, Z1, ...; then rows of 2 + 3 NumMarkers cells each, otherwise the file is
// refused. A marker with an empty cell is missing. Blank lines may precede the first row, and the
// first one after it ends the table.
inline Markers read_trc(const std::string& text) {
  const auto refuse = [](const std::string& why) { throw InputError(why); };
  const auto lines = split(text, '\n');
  if (lines.size() < 6 || !lines[0].starts_with("PathFileType")) refuse("no header");
  const auto keys = without_empty(cells_of(lines[1])), values = without_empty(cells_of(lines[2]));
  if (keys.size() != 8 || values.size() != 8 || keys[3] != "NumMarkers") refuse("keys");
  const size_t markers = std::stoul(values[3]);
  Markers out;
  out.names = without_empty(cells_of(lines[3]));
  if (out.names.size() != markers + 2 || out.names[0] != "Frame#" || out.names[1] != "Time")
    refuse("names");
  out.names.erase(out.names.begin(), out.names.begin() + 2);
  const auto axes = without_empty(cells_of(lines[4]));
  for (size_t k = 0; k < 3 * markers; ++k)
    if (axes.at(k) != std::string(1, "XYZ"[k % 3]) + std::to_string(k / 3 + 1)) refuse("axes");
  size_t line = 5;
  while (line < lines.size() && cells_of(lines[line]).empty()) ++line;
  for (; line < lines.size() && !cells_of(lines[line]).empty(); ++line) {
    const auto cells = cells_of(lines[line]);
    if (cells.size() != 3 * markers + 2)
      refuse("expected " + std::to_string(3 * markers + 2) + " cells, found " +
             std::to_string(cells.size()));
    out.time.push_back(std::stod(cells[1]));
    std::vector<Eigen::Vector3d>& row = out.rows.emplace_back();
    for (size_t c = 2; c < cells.size(); c += 3) {
      const bool known = !cells[c].empty() && !cells[c + 1].empty() && !cells[c + 2].empty();
      row.push_back(known ? Eigen::Vector3d(std::stod(cells[c]), std::stod(cells[c + 1]),
                                            std::stod(cells[c + 2]))
                          : Eigen::Vector3d::Constant(NAN));
    }
  }
  if (out.rows.size() != std::stoul(values[2])) refuse("frames");
  return out;
}

// A storage file's columns by name, and its rows.
struct Storage {
  std::vector<std::string> names;
  std::vector<std::vector<double>> rows;
  std::vector<double> column(const std::string& name) const {
    const auto at = std::find(names.begin(), names.end(), name) - names.begin();
    std::vector<double> out;
    for (const auto& row : rows) out.push_back(row.at(static_cast<size_t>(at)));
    return out;
  }
  std::map<std::string, double> row(size_t index) const {
    std::map<std::string, double> out;
    for (size_t i = 0; i < names.size(); ++i) out[names[i]] = rows.at(index).at(i);
    return out;
  }
};

// As OpenSim's DelimFileAdapter reads it: lines with '=' are keys, the names follow "endheader",
// the first is "time", every row has as many cells as there are names.
inline Storage read_storage(const std::string& text) {
  std::istringstream stream(text);
  std::map<std::string, std::string> keys;
  std::string line;
  while (std::getline(stream, line) && line != "endheader")
    if (const size_t at = line.find('='); at != std::string::npos)
      keys[line.substr(0, at)] = line.substr(at + 1);
  Storage out;
  std::getline(stream, line);
  out.names = split(line, '\t');
  while (std::getline(stream, line)) {
    out.rows.emplace_back();
    for (const std::string& cell : split(line, '\t')) out.rows.back().push_back(std::stod(cell));
    EXPECT_EQ(out.rows.back().size(), out.names.size());
  }
  EXPECT_EQ(out.names.front(), "time");
  EXPECT_EQ(keys["version"], "1");
  EXPECT_EQ(keys["nRows"], std::to_string(out.rows.size()));
  EXPECT_EQ(keys["nColumns"], std::to_string(out.names.size()));
  EXPECT_EQ(keys.size(), 4u);  // with inDegrees: no sentence was taken for a key
  return out;
}

inline Eigen::Matrix3d about(const Eigen::Vector3d& axis, double angle_deg) {
  return Eigen::AngleAxisd(rad_from_deg(angle_deg), axis).toRotationMatrix();
}

// The model in OpenSim with the written coordinates: its pelvis, hips at their place in the
// Rajagopal model for a pelvis of the subject's size, thighs, shanks and feet of the subject's
// lengths. Joints in OpenSim's ground.
inline std::map<std::string, Eigen::Vector3d> opensim_joints(std::map<std::string, double> row,
                                                             const BodyLengths& lengths) {
  const auto x = Eigen::Vector3d::UnitX(), y = Eigen::Vector3d::UnitY(),
             z = Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d origin(row["pelvis_tx"], row["pelvis_ty"], row["pelvis_tz"]);
  const Eigen::Matrix3d pelvis = about(z, row["pelvis_tilt"]) * about(x, row["pelvis_list"]) *
                                 about(y, row["pelvis_rotation"]);
  const double scale = (lengths.thigh + lengths.shank) / 0.81;
  std::map<std::string, Eigen::Vector3d> out;
  for (const std::string end : {"l", "r"}) {
    const double right = end == "r" ? 1 : -1;
    const auto angle = [&](const std::string& name) { return row[name + "_" + end]; };
    const Eigen::Vector3d hip =
        origin + pelvis * Eigen::Vector3d(-0.056276 * scale, -0.07849 * scale,
                                          right * 0.5 * lengths.hip_width);
    const Eigen::Matrix3d thigh = pelvis * about(z, angle("hip_flexion")) *
                                  about(right * x, angle("hip_adduction")) *
                                  about(right * y, angle("hip_rotation"));
    const Eigen::Matrix3d shank = thigh * about(z, -angle("knee_angle"));
    const Eigen::Matrix3d foot = shank * about(z, angle("ankle_angle"));
    const Eigen::Vector3d knee = hip - lengths.thigh * thigh.col(1),
                          ankle = knee - lengths.shank * shank.col(1);
    out[end + "hip"] = hip;
    out[end + "knee"] = knee;
    out[end + "ankle"] = ankle;
    out[end + "toe"] =
        ankle +
        foot * Eigen::Vector3d(lengths.ball_forward, lengths.ball_height - lengths.ankle_height, 0);
  }
  return out;
}

}  // namespace walktrack
