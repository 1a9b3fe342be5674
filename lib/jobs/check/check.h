// `walktrack check`: checks a scene. It reports where every camera stands and what it sees, and
// finds common mistakes in calibrations and recordings: a camera below the ground or upside down,
// millimetres instead of metres, a transposed or inverted pose, a wrong image size, unequal or
// variable frame rates, rotated phone video, cameras that are not synchronous. It gives advice for
// every mistake.
//
// The fast checks also precede tracking: calibrations, sizes, rates and time stamps without
// decoding a frame, and for two or more cameras the first frames, to test whether they are
// synchronous.
//
// Mistakes that make a scene unreadable (a matrix that is not a rotation, a mirrored one, unknown
// keys) are InputErrors of the readers, with their place and advice.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "camera/inspection.h"
#include "core/job_control.h"
#include "io/scene/scene.h"
#include "io/video/video_facts.h"

namespace walktrack {
inline namespace jobs {

struct CheckJob {
  std::filesystem::path scene;
  std::filesystem::path pictures;  // folder for check_<camera>.png; empty = none
};

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

CheckReport check_scene(const CheckJob& job, const JobControl& control);

// The checks with which `track` begins.
CheckReport look_at_scene(const Scene& scene, const JobControl& control);

// A finding as one line: "cam1: stands 3.20 m underground; cure: ...".
std::string finding_line(const Finding& finding);

// The report as text: one paragraph for each camera, then the findings.
std::string check_text(const CheckReport& report);
// The report as JSON.
std::string check_json(const CheckReport& report);

}  // namespace jobs
}  // namespace walktrack
