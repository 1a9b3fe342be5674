// Reads motion capture of other programs, TRC (OpenSim, Pose2Sim, OpenCap, Cortex) and C3D
// (c3d.org; Vicon, Qualisys, Motion Analysis) files of joint centres or markers, as a motion.
//
// The vertical axis follows from hips and ankles. Points are recognised by name, without regard to
// case, a subject's prefix "name:", "_", "-", "." and "study":
//   joint centres   LHip, LHJC, LeftHip, Hip_L, LFEP; LKnee, LKJC, LFEO; LAnkle, LAJC, LTIO; LToe,
//                   LBigToe; Neck, C7; Head; LShoulder, LSJC, LSHO; LElbow, LEJC; LWrist, LWJC
//   both sides of a joint, whose middle is taken: LKNE, LKnee, LLFE with LKNM, LMKnee, LMKNE, LMFE;
//                   LANK, LAnkle, LLM with LANM, LMAnkle, LMANK, LMM
//   pelvis markers  LASI, RASI and LPSI, RPSI or SACR: hip centres by the regression of
//                   Harrington et al., J. Biomech. 40 (2007)
// and the same names with R. The pelvis is the midpoint of the hips. Other points are ignored.
#pragma once

#include <filesystem>

#include "body/motion.h"
#include "io/tables/marker_table.h"

namespace walktrack {
inline namespace io {

// With z up, in metres. Throws an InputError that names what is missing if there are not two hips,
// knees and ankles.
Motion motion_from_markers(const MarkerTable& markers);

// Decided by the name's ending: .trc, .c3d.
bool is_marker_file(const std::filesystem::path& path);
// InputError with place, found and allowed.
Motion read_marker_motion(const std::filesystem::path& path);

}  // namespace io
}  // namespace walktrack
