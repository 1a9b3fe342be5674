// joints.c3d: the file of gait laboratories (C3D User Guide, Motion Lab Systems, c3d.org), read by
// Mokka, Visual3D, Vicon Nexus, Qualisys, ezc3d and BTK. Little-endian floats.
//
// Axes are the library's world: right-handed, z up, the ground z = 0; lengths in mm, as in the
// files of laboratories. Frame 1 is the motion's first row, which is time 0 of the events.
//
//   POINT      joint centres under the names of joints.csv, residual 0 (computed, not measured) or
//              -1 where unknown; then angles in degrees as points, named in POINT:ANGLES:
//              LHipAngles, RHipAngles: flexion, adduction, rotation (toes inwards);
//              LKneeAngles, …: flexion, 0, 0; LAnkleAngles, …: dorsiflexion, 0, 0;
//              PelvisAngles: tilt (upper end forwards), list (right side down), turn to the left
//              from the world's x axis; TrunkAngles: against the pelvis, flexion, bending to the
//              right, turn to the left
//   EVENT      "Foot Strike" and "Foot Off" with contexts "Left" and "Right", minutes and seconds
//   ANALOG,    with forces: two level plates of type 2 as large as the walk, the left foot's and
//   FORCE_PLATFORM  the right's, one sample a frame: Fx, Fy, Fz (N), Mx, My, Mz (N mm) about the
//              plate's centre, of the ground on the foot as in the files of Vicon, in the plate's
//              axes, z down. 0 where the forces are not known.
//   TRIAL      the number of frames, which may be more than the header can count (65,535)
//   MANUFACTURER  the program
#pragma once

#include <span>
#include <string>

#include "body/motion.h"
#include "io/tables/angles_file.h"
#include "kinetics/kinetics.h"
#include "metrics/gait.h"

namespace walktrack {
inline namespace io {

struct C3dContent {
  const Motion& motion;              // at least one row, evenly spaced
  double rate;                       // Hz
  std::span<const AngleRow> angles;  // one for each row, or none
  std::span<const GaitEvent> events;
  const Kinetics* kinetics = nullptr;  // of the same rows; nullptr: no forces
};

// The bytes of the file. If there are more events than the parameter section can hold (127 kB,
// about 3,500), the later ones are left out.
std::string c3d_from_motion(const C3dContent& content);

}  // namespace io
}  // namespace walktrack
