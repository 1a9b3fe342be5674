#include "jobs/track/results/named_track.h"

#include <algorithm>

#include "tracker/moves/mirror_legs.h"
#include "tracker/smooth/leg_labels.h"

namespace walktrack {
inline namespace jobs {

bool says_names(const TrackedFrames& frames) {
  for (const FrameRecord& record : frames.records)
    if (record.names != 0) return true;
  return false;
}

TrackedFrames named(const TrackedFrames& frames, const Body& body,
                    const std::filesystem::path& file) {
  std::vector<NamedFrame> seen;
  for (const FrameRecord& record : frames.records)
    seen.push_back({record.tracked, record.names, record.modes.p_legs_swapped});
  const std::vector<double> swapped = swapped_probabilities(seen, 1 / frames.frame_rate);
  TrackedFrames out{frames.frame_rate, FrameFile(file)};
  std::filesystem::remove(
      file);  // an open file can still be read, and is deleted when it is closed
  auto probability = swapped.begin();
  for (FrameRecord record : frames.records) {
    const double p = *probability++;
    if (p > 0.5) mirror_legs(body, record);
    if (record.tracked) record.modes.p_legs_swapped = std::min(p, 1 - p);
    out.records.append(record);
  }
  return out;
}

}  // namespace jobs
}  // namespace walktrack
