// Time stamps of a video's frames from its container. Only the packets' headers are read, so that a
// file of 100 frames takes a millisecond; nothing is decoded.
#pragma once

#include <filesystem>
#include <vector>

#include "io/video/video_facts.h"

namespace walktrack {
inline namespace io {

// Time stamps of the frames in presentation order, s after the first one; empty if the file is not
// a video, has frames without a time stamp, or there is no video ("").
std::vector<double> frame_stamps(const std::filesystem::path& video);

// The usual step between time stamps, and the steps that differ from it.
struct StampSteps {
  double usual = 0;  // s, mean of the steps near their median; 0 = fewer than three
  int dropped = 0;   // missing frames, counted from steps of several times the usual one
  int uneven = 0;    // steps that are not a multiple of the usual one
};
StampSteps steps_of(const std::vector<double>& stamps);

// The rate of most frames, Hz: the average rate that the container states, unless it is affected by
// dropped frames. 0 = unknown.
double usual_rate(const VideoFacts& facts, const StampSteps& steps);

}  // namespace io
}  // namespace walktrack
