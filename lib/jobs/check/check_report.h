// What `walktrack check` finds in a scene, and its report as text and as JSON.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

#include "camera/inspection.h"
#include "io/video/video_facts.h"

namespace walktrack {
inline namespace jobs {

struct Finding {
  std::string camera;  // empty = the scene
  bool failure;        // otherwise a remark
  std::string what, cure;
  bool may_be_lag = false;  // cameras that began at different times would explain it
};

struct CheckedCamera {
  std::string name;
  CameraInspection view;
  VideoFacts video;
};

// The lag between two cameras as estimated from the walk, if the scene does not state it.
struct FoundLag {
  size_t camera;     // the camera that lags: it starts at `frames`, the other one at 0
  int frames;        // of the scene, > 0
  double sd_frames;  // standard deviation
};

struct CheckReport {
  std::vector<CheckedCamera> cameras;
  std::vector<Finding> findings;
  std::optional<FoundLag> lag;  // which `track` corrects
  bool failed() const;
};

// A finding as one line: "cam1: stands 3.20 m underground; cure: ...".
std::string finding_line(const Finding& finding);

// The report as text: one paragraph for each camera, then the findings.
std::string check_text(const CheckReport& report);
// The report as JSON.
std::string check_json(const CheckReport& report);

}  // namespace jobs
}  // namespace walktrack
