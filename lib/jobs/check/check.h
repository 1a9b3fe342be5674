// `walktrack check`: checks a scene. It says where every camera stands and what it sees, and finds
// the usual mistakes of calibrations and recordings: a camera underground or upside down,
// millimetres for metres, a transposed or inverted pose, a wrong image size, unequal or varying
// frame rates, turned phone video, cameras out of step. A mistake comes with its cure.
//
// The checks that cost little are made before a scene is tracked, too: calibrations, sizes, rates
// and time stamps without decoding a frame, and for two or more cameras the first frames, to see
// whether they are in step.
//
// Mistakes that make a scene unreadable (a matrix that is not a rotation, a mirrored one, unknown
// keys) are InputErrors of the readers, with their place and cure.
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
  bool failure;        // otherwise worth knowing only
  std::string what, cure;
  bool may_be_lag = false;  // cameras that began at different moments would explain it
};

struct CheckedCamera {
  std::string name;
  CameraInspection view;
  VideoFacts video;
};

// By how much one of two cameras shows things later than the other, found from the walk, where the
// scene does not state it.
struct FoundLag {
  size_t camera;     // the late one: it starts at `frames`, the other one at 0
  int frames;        // of the scene, > 0
  double sd_frames;  // standard deviation
};

struct CheckReport {
  std::vector<CheckedCamera> cameras;
  std::vector<Finding> findings;
  std::optional<FoundLag> lag;  // that `track` takes out
  bool failed() const;
};

CheckReport check_scene(const CheckJob& job, const JobControl& control);

// The part of it that `track` begins with.
CheckReport look_at_scene(const Scene& scene, const JobControl& control);

// A finding as one line: "cam1: stands 3.20 m underground; cure: ...".
std::string finding_line(const Finding& finding);

// The report for people, one paragraph a camera, findings last.
std::string check_text(const CheckReport& report);
// The same for programs.
std::string check_json(const CheckReport& report);

}  // namespace jobs
}  // namespace walktrack
