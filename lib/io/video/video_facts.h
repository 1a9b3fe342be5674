// Facts about a source of frames.
#pragma once

namespace walktrack {
inline namespace io {

struct VideoFacts {
  int width_px = 0, height_px = 0;  // of the frames as delivered
  double frame_rate = 0;            // Hz; 0 = unknown (images)
  int missing = 0;                  // missing images according to the numbers in names
  int frame_count = 0;   // according to the container, or images including missing ones; 0 =
                         // unknown
  int rotation_deg = 0;  // rotation flag of the file, clockwise (phones)
  bool rotated = false;  // whether frames are rotated by it
};

}  // namespace io
}  // namespace walktrack
