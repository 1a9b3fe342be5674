// What a track has estimated that holds for the whole recording: the subject's height and shape,
// the lag between two cameras, and where keypoints lie beside the joints. Each with its standard
// deviation and what it did to the result; only those that the scene leaves open.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "io/archive/run_record.h"
#include "io/scene/scene.h"
#include "jobs/check/check_report.h"
#include "observation/keypoints/keypoint_term.h"
#include "tracker/tracked_subject.h"

namespace walktrack {
inline namespace jobs {

struct ConstantSources {
  const Scene& scene;
  double frame_rate = 0;  // Hz, of the scene
  double speed = 0;       // m/s, mean of the subject's
  SubjectEstimates subject;
  std::optional<FoundLag> lag;
  std::span<const KeypointTerm::State> keypoints;  // by camera
};

std::vector<RecordingConstant> recording_constants(const ConstantSources& sources);

}  // namespace jobs
}  // namespace walktrack
