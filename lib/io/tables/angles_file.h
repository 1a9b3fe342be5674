// angles.csv: the joint angles of body/joint_angles.h in degrees, one row a frame.
//
// Comment lines that start with '#' say rate, zero and signs. Then t,<angle>_deg,<angle>_deg_p05,
// <angle>_deg_p95,… A frame without a pose has empty cells; so has a band that nobody knows.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "body/joint_angles.h"
#include "body/motion.h"
#include "body/subject.h"

namespace walktrack {

struct AngleRow {
  double time;                          // s
  std::optional<Pose> pose;             // nullopt: unknown
  std::optional<JointAngles> p05, p95;  // rad
};

// The poses that follow from joints alone (body/pose_from_joints.h), without bands.
std::vector<AngleRow> angle_rows(const Motion& motion, const BodyLengths& lengths);

// `rate` in Hz.
std::string joint_angles_csv(const std::vector<AngleRow>& rows, double rate);

}  // namespace walktrack
