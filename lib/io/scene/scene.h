// A recording: scene.yaml, the calibrations of the cameras and the subject, as plain structs in the
// library's world (z up, ground z = 0), whatever axes the calibration has.
//
// Paths in the file are relative to it; here they are absolute. Every key, type and range is
// checked, and files must exist. Errors are InputErrors "file:line: key: found X, allowed Y".
#pragma once

#include <filesystem>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "body/subject.h"
#include "camera/camera.h"
#include "camera/world_frame.h"
#include "io/keypoints/keypoint_file.h"

namespace walktrack {
inline namespace io {

inline constexpr double kSlowestRate = 0.1, kFastestRate = 1000;  // of frames, Hz

using Polygon = std::vector<Eigen::Vector2d>;  // corners, px

// An object in front of the subject, always or for a while, for example a parked van or an open
// door.
struct Occluder {
  Polygon outline;
  double from = -std::numeric_limits<double>::infinity();  // s after first_frame
  double to = std::numeric_limits<double>::infinity();     // s, the last moment
};

struct SceneCamera {
  std::string name;                   // unique; fit for a file name
  std::filesystem::path video;        // file, folder of frames or printf pattern; empty = none
  std::filesystem::path calibration;  // the file that `camera` was read from
  std::filesystem::path background;   // frames of the empty scene; empty = none
  KeypointSource keypoints;           // may replace a video
  Camera camera;                      // in the world
  int start_frame = 0;                // the first frame of the scene in its video
  bool start_given = false;           // otherwise `track` may estimate it from the walk
  std::optional<double> frame_rate;   // Hz, if it differs from the scene's
  std::vector<Occluder> occluders;
};

// The subject's state at the beginning, as far as it is known.
struct InitialState {
  double time = 0;              // s after first_frame
  Eigen::Vector2d position;     // on the ground, world axes, m
  double heading = 0;           // from world x towards world y, rad
  std::optional<double> speed;  // m/s
  std::optional<double> phase;  // share of the stride since left foot strike, 0..1
};

// Where the subject is at a time: who they are, if several people walk.
struct SubjectPlace {
  double time = 0;           // s after first_frame
  Eigen::Vector2d position;  // on the ground, world axes, m
};

struct Scene {
  std::filesystem::path file;
  std::vector<SceneCamera> cameras;         // at least one
  std::optional<double> frame_rate;         // Hz; otherwise the video's
  WorldFrame world;                         // world_from_calibration
  Eigen::Vector3d gravity{0, 0, -9.80665};  // world axes, m/s^2; a slope tilts it
  Subject subject;
  bool height_given = true, mass_given = true;  // otherwise usual values are used
  bool girth_given = false;                     // otherwise one camera may estimate it
  std::optional<double> height_sd;              // m, of a height that is known roughly
  std::filesystem::path subject_file;           // that states the subject; empty = the scene
  std::optional<InitialState> initial;
  std::optional<SubjectPlace> near;  // not with `initial`
  std::filesystem::path truth;       // empty = none
  int first_frame = 0;               // time 0
  std::optional<int> last_frame;     // inclusive; otherwise the end of the shortest video
};

// The occluders that are present at a time, s after first_frame.
std::vector<Polygon> occluders_at(const SceneCamera& camera, double time);

Scene read_scene(const std::filesystem::path& path);

// The scene's own file and all files that it names: videos, calibrations, backgrounds, keypoints,
// the subject, truth.
std::vector<std::filesystem::path> files_of(const Scene& scene);

// Whether a path denotes many files, e.g. frames/%05d.png.
bool is_frame_pattern(const std::filesystem::path& path);

}  // namespace io
}  // namespace walktrack
