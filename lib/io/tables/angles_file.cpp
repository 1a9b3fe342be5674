#include "io/tables/angles_file.h"

#include <limits>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "body/pose_from_joints.h"
#include "core/conventions.h"
#include "io/tables/csv.h"

namespace walktrack {
inline namespace io {

std::vector<AngleRow> angle_rows(const Motion& motion, const BodyLengths& lengths) {
  std::vector<AngleRow> rows;
  for (size_t i = 0; i < motion.time.size(); ++i)
    rows.push_back({motion.time[i], pose_from_joints(motion.joints[i], lengths), {}, {}});
  return rows;
}

TableNotes joint_angles_notes(double rate) {
  const nlohmann::ordered_json notes = {
      {"rate_hz", json_number(rate)},
      {"units", "t in s from the scene's first frame, angles in degrees"},
      {"bands", "_p05, _p95: 5-95 % band of the tracker; empty where nothing is known"},
      {"zero", "upright, feet flat and ahead"},
      {"positive",
       "hips flexed, adducted, toes inwards; knees flexed; ankles dorsiflexed; pelvis and "
       "trunk tilted backwards, right side down, turned left (pelvis_rotation: from the "
       "world's x axis); lumbar: trunk against pelvis, backwards, to the right, to the left"},
      {"names", "as in OpenSim's Rajagopal model and angles.mot"}};
  return {"angles.csv", notes.dump()};
}

std::string joint_angles_csv(const std::vector<AngleRow>& rows) {
  std::string text = "t";
  for (const std::string_view name : kJointAngleNames)
    text += fmt::format(",{0}_deg,{0}_deg_p05,{0}_deg_p95", name);
  text += "\n";
  for (const AngleRow& row : rows) {
    text += csv_number(row.time);
    const JointAngles values = row.pose ? joint_angles(*row.pose) : JointAngles{};
    const auto append = [&](bool known, const JointAngles& angles, size_t k) {
      append_number(text, ',',
                    known ? deg_from_rad(angles[k]) : std::numeric_limits<double>::quiet_NaN());
    };
    for (size_t k = 0; k < kJointAngleCount; ++k) {
      append(row.pose.has_value(), values, k);
      append(row.p05.has_value(), row.p05.value_or(JointAngles{}), k);
      append(row.p95.has_value(), row.p95.value_or(JointAngles{}), k);
    }
    text += "\n";
  }
  return text;
}

}  // namespace io
}  // namespace walktrack
