// The truth that estimates are compared with.
#pragma once

#include <filesystem>
#include <optional>
#include <variant>
#include <vector>

#include "body/motion.h"
#include "metrics/references.h"

namespace walktrack {
inline namespace jobs {

// A truth is recognised by its header:
//   t,pelvis_x,…                             joints (joints.csv)
//   stance,side,on_frame,off_frame,x_m       foot plants; first and last frames, inclusive
//   t,x,y                                    ground points
//   frame,…,RHip_x,…                         key points of Pose2Sim; only joints of the body
//                                            model are used
using Truth = std::variant<Motion, std::vector<FootPlant>, GroundPoints>;

// `frame_rate` converts frames to seconds; files with times do not need it. InputError for any
// other header, naming it.
Truth read_truth(const std::filesystem::path& path, std::optional<double> frame_rate);

}  // namespace jobs
}  // namespace walktrack
