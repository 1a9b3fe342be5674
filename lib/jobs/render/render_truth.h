// The tables and images of the truth of a rendered video.
#pragma once

#include <filesystem>
#include <string>

#include "body/motion.h"
#include "synth/recording/view.h"

namespace walktrack {
inline namespace jobs {

// t,side,event with side l or r and event strike or toe_off: the events of the whole motion within
// the time of the truth.
std::string events_csv(const Motion& whole, double duration);

void write_labels(const std::filesystem::path& file, const Plane<uint8_t>& labels);

// Middlebury .flo: "PIEH", width, height, then u, v as 32-bit floats, row by row; 1e10 = unknown.
void write_flow(const std::filesystem::path& file, const Plane<Eigen::Vector2f>& flow);

// Portable float map, one channel, little-endian, rows bottom-up; infinite = sky.
void write_depth(const std::filesystem::path& file, const Plane<float>& depth);

}  // namespace jobs
}  // namespace walktrack
