#include "io/tables/angles_file.h"

#include <limits>

#include <fmt/format.h>

#include "body/pose_from_joints.h"
#include "core/conventions.h"
#include "io/tables/csv.h"

namespace walktrack {

std::vector<AngleRow> angle_rows(const Motion& motion, const BodyLengths& lengths) {
  std::vector<AngleRow> rows;
  for (size_t i = 0; i < motion.time.size(); ++i)
    rows.push_back({motion.time[i], pose_from_joints(motion.joints[i], lengths), {}, {}});
  return rows;
}

std::string joint_angles_csv(const std::vector<AngleRow>& rows, double rate) {
  std::string text = fmt::format(
      "# Joint angles in degrees, t in s, {:.6g} Hz; _p05, _p95: 5-95 % band of the tracker.\n"
      "# Zero: upright, feet flat and ahead. Positive: hips flexed, adducted, toes inwards; knees\n"
      "# flexed; ankles dorsiflexed; pelvis and trunk tilted backwards, right side down, turned\n"
      "# left (pelvis_rotation: from the world's x axis); lumbar: trunk against pelvis, "
      "backwards,\n"
      "# to the right, to the left. Names and signs as in OpenSim's Rajagopal model and "
      "angles.mot\n"
      "t",
      rate);
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

}  // namespace walktrack
