// angles.csv: the joint angles of body/joint_angles.h in degrees, one row for each frame.
//
// t,<angle>_deg,<angle>_deg_p05,<angle>_deg_p95,… Cells are empty in a frame without a pose, and
// for unknown bands. Zero positions and signs are described in tables.json.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "body/joint_angles.h"
#include "body/motion.h"
#include "body/subject.h"
#include "io/tables/table_notes.h"

namespace walktrack {
inline namespace io {

struct AngleRow {
  double time;                          // s
  std::optional<Pose> pose;             // nullopt: unknown
  std::optional<JointAngles> p05, p95;  // rad
};

// The poses that follow from the joints alone (body/pose_from_joints.h), without bands.
std::vector<AngleRow> angle_rows(const Motion& motion, const BodyLengths& lengths);

std::string joint_angles_csv(const std::vector<AngleRow>& rows);

// The notes on "angles.csv"; `rate` in Hz.
TableNotes joint_angles_notes(double rate);

}  // namespace io
}  // namespace walktrack
