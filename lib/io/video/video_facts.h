// What a source of frames says about itself.
#pragma once

namespace walktrack {
inline namespace io {

struct VideoFacts {
  int width_px = 0, height_px = 0;  // of the frames as delivered
  double frame_rate = 0;            // Hz; 0 = not known (images)
  int missing = 0;                  // images that the numbers in the others' names leave out
  int frame_count = 0;   // as the container says, or images with the missing; 0 = unknown
  int rotation_deg = 0;  // turn that the file asks for, clockwise (phones)
  bool rotated = false;  // whether frames are delivered turned by it
};

}  // namespace io
}  // namespace walktrack
