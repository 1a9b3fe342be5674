#include "jobs/track/results/planted_track.h"

#include "metrics/flat_feet.h"
#include "tracker/smooth/planting.h"

namespace walktrack {
inline namespace jobs {

TrackedFrames planted(const TrackedFrames& frames, const std::filesystem::path& file) {
  const Motion motion = motion_of(frames);
  const auto shifts = planting_shifts(motion, flat_feet(motion, gait_from_motion(motion)));
  TrackedFrames out{frames.frame_rate, FrameFile(file)};
  std::filesystem::remove(file);  // what is open can still be read, and leaves nothing behind
  size_t row = 0;
  for (FrameRecord record : frames.records) {
    plant_feet(shifts[row++], record);
    out.records.append(record);
  }
  return out;
}

}  // namespace jobs
}  // namespace walktrack
