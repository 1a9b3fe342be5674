// The track as it is reported: with the labels of the legs decided by the whole video, all frames
// estimated together, and supporting feet that do not move. Each of these is a hidden file of the
// result folder until the result is complete.
#pragma once

#include <optional>

#include "io/archive/result_folder.h"
#include "jobs/track/results/track_results.h"
#include "tracker/smooth/posterior.h"

namespace walktrack {
inline namespace jobs {

// What else counts in the most probable poses of frames together.
struct Together {
  std::span<const FlatFoot> flat = {};  // soles in place
  bool walk_prior = true;               // what is known of walks (tracker/walk_prior.h)
  // With bands and samples of this scene (tracker/smooth/posterior.h), if one is given.
  const BandScene* bands = nullptr;
};

// The frames with their most probable poses together (tracker/smooth/trajectory.h). Long tracks are
// taken in pieces that begin with what has been settled, so that of all frames only the directions
// of the walk are in memory. The records lie in a file of that name, which is deleted when it is
// closed.
TrackedFrames seen_together(const TrackedFrames& frames, const BodyModel& model,
                            const Together& together, const std::filesystem::path& file);

// The periods in which soles lie flat: by the gait of the track, if the feet do not move, and both
// soles of a subject who stands.
std::vector<FlatFoot> standing_feet(const TrackedFrames& frames);

class ReportedTrack {
 public:
  ReportedTrack(const TrackedFrames& tracked, const BodyModel& model,
                const SmoothingConfig& smoothing, const BandScene& bands,
                const ResultFolder& folder);
  ReportedTrack(const ReportedTrack&) = delete;
  ReportedTrack& operator=(const ReportedTrack&) = delete;

  // Before feet are held in place; if they will be, also before what is known of walks counts.
  const TrackedFrames& moving() const {
    return smoothed_ ? *smoothed_ : named_ ? *named_ : tracked_;
  }
  const TrackedFrames& frames() const { return planted_ ? *planted_ : moving(); }

 private:
  const TrackedFrames& tracked_;
  std::optional<TrackedFrames> named_, smoothed_, planted_;
};

}  // namespace jobs
}  // namespace walktrack
