// When a video's frames were taken, as its container says. Only the packets' headers are looked at,
// so that a file of 100 frames takes a millisecond; nothing is decoded.
#pragma once

#include <filesystem>
#include <vector>

#include "io/video/video_facts.h"

namespace walktrack {
inline namespace io {

// Time stamps of the frames in the order in which they are shown, s after the first one; empty if
// the file is no video or has frames without a stamp, and for a camera without a video ("").
std::vector<double> frame_stamps(const std::filesystem::path& video);

// What most frames have in common: the usual step between neighbours, and which steps are others.
struct StampSteps {
  double usual = 0;  // s, the mean of the steps that are like their median; 0 = fewer than three
  int dropped = 0;   // frames that are missing between others, as steps of several times the usual
  int uneven = 0;    // steps that are no multiple of the usual one
};
StampSteps steps_of(const std::vector<double>& stamps);

// The rate of most frames, Hz: the container's own word, which is an average, unless dropped frames
// or the like have made it another one. 0 = not known.
double usual_rate(const VideoFacts& facts, const StampSteps& steps);

}  // namespace io
}  // namespace walktrack
