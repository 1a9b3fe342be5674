#include "io/scene/scene.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <Eigen/Geometry>

#include "core/conventions.h"
#include "core/errors.h"
#include "io/archive/files.h"
#include "io/calibration/calibration.h"
#include "io/config/yaml.h"
#include "io/scene/scene_template.h"
#include "io/scene/subject_file.h"

namespace walktrack {
inline namespace io {

namespace fs = std::filesystem;

namespace {

constexpr double kWeakestGravity = 0.1, kStrongestGravity = 100;  // m/s^2
constexpr double kSteepestSlope_deg = 60;
constexpr int kMostFrames = std::numeric_limits<int>::max() / 2;

Eigen::Vector3d vector3(const YamlValue& value) { return Eigen::Vector3d(value.numbers(3).data()); }

// Returns a path, which must exist unless it is a pattern.
fs::path existing_path(const YamlValue& value, const fs::path& folder) {
  fs::path path = resolved(folder, value.text());
  std::error_code ignored;
  if (!is_frame_pattern(path) && !fs::exists(path, ignored)) {
    value.fail(fmt::format("'{}'", value.text()),
               fmt::format("a file that exists ({} does not)", path.string()));
  }
  return path;
}

// The file's own name of each keypoint; the map's values are those names.
std::map<std::string, std::string> read_point_names(const YamlValue& map) {
  const std::vector<std::string> ours(kKeypointNames.begin(), kKeypointNames.end());
  map.only_keys(ours);
  std::map<std::string, std::string> names;
  for (const std::string& key : map.keys()) names[key] = map.at(key).text();
  if (names.empty()) map.fail("an empty map", "at least one point, such as {left_knee: kneeL}");
  return names;
}

// Reads a path, or a map that contains a path.
KeypointSource read_keypoint_source(const YamlValue& value, const fs::path& folder) {
  if (!value.is_map()) return {.path = existing_path(value, folder)};
  value.only_keys({"file", "map"});
  KeypointSource source{.path = existing_path(value.at("file"), folder)};
  if (value.has("map")) source.names = read_point_names(value.at("map"));
  return source;
}

void require_pictures_or_points(const YamlValue& value, const SceneCamera& camera) {
  if (camera.video.empty() && camera.keypoints.path.empty())
    value.fail("neither 'video' nor 'keypoints'", "one of them, or both");
  if (camera.video.empty() && !camera.background.empty())
    value.at("background").fail("pictures of the empty scene without a video", "them with one");
}

SceneCamera read_camera(const YamlValue& value, const fs::path& folder, const WorldFrame& world) {
  value.only_keys(
      {"name", "video", "calibration", "background", "keypoints", "start_frame", "frame_rate"});
  SceneCamera camera;
  camera.name = value.at("name").name();
  if (value.has("video")) camera.video = existing_path(value.at("video"), folder);
  camera.calibration = existing_path(value.at("calibration"), folder);
  if (value.has("background")) camera.background = existing_path(value.at("background"), folder);
  if (value.has("keypoints"))
    camera.keypoints = read_keypoint_source(value.at("keypoints"), folder);
  require_pictures_or_points(value, camera);
  if (value.has("start_frame")) {
    camera.start_frame = value.at("start_frame").integer(0, kMostFrames);
    camera.start_given = true;
  }
  if (value.has("frame_rate")) {
    camera.frame_rate = value.at("frame_rate").number(kSlowestRate, kFastestRate);
  }
  camera.camera = camera_in_world(world, read_calibration(camera.calibration, camera.name));
  return camera;
}

std::vector<SceneCamera> read_cameras(const YamlValue& list, const fs::path& folder,
                                      const WorldFrame& world) {
  std::vector<SceneCamera> cameras;
  for (const YamlValue& value : list.items()) {
    cameras.push_back(read_camera(value, folder, world));
    for (size_t i = 0; i + 1 < cameras.size(); ++i) {
      if (cameras[i].name == cameras.back().name) {
        value.at("name").fail(fmt::format("'{}' twice", cameras[i].name), "a name of its own");
      }
    }
  }
  if (cameras.empty()) list.fail("an empty list", "at least one camera");
  return cameras;
}

WorldFrame read_ground(const YamlValue& root) {
  if (!root.has("ground")) return {};
  const YamlValue ground = root.at("ground");
  ground.only_keys({"normal", "offset"});
  Eigen::Vector3d normal(0, 0, 1);
  if (ground.has("normal")) {
    normal = vector3(ground.at("normal"));
    if (!(normal.norm() > 1e-6)) ground.at("normal").fail("no direction", "a vector, not zero");
  }
  const double offset = ground.has("offset") ? ground.at("offset").number() : 0;
  return world_frame_on_ground(normal, offset);
}

Eigen::Vector3d read_gravity(const YamlValue& root, const WorldFrame& world) {
  if (!root.has("gravity")) return Scene{}.gravity;
  const YamlValue value = root.at("gravity");
  Eigen::Vector3d gravity = world.rotation * vector3(value);
  const double strength = gravity.norm();
  if (!(strength >= kWeakestGravity && strength <= kStrongestGravity)) {
    value.fail(fmt::format("{:g} m/s^2", strength),
               fmt::format("{:g} to {:g} m/s^2", kWeakestGravity, kStrongestGravity));
  }
  const double slope_deg = deg_from_rad(std::acos(-gravity.z() / strength));
  if (slope_deg > kSteepestSlope_deg) {
    value.fail(fmt::format("gravity {:.0f} degrees off the ground's downward normal", slope_deg),
               fmt::format("at most {:.0f}", kSteepestSlope_deg));
  }
  return gravity;
}

void state_subject(const StatedSubject& stated, Scene& scene) {
  scene.subject = stated.subject;
  scene.height_given = stated.height_stated && !stated.height_sd;
  scene.height_sd = stated.height_sd;
  scene.mass_given = stated.mass_stated;
  scene.girth_given = stated.girth_stated;
  scene.subject_file = stated.file;
}

// Whether z of the calibration points up so nearly that (x, y) and an angle define a place and a
// direction.
bool z_is_up(const WorldFrame& world) { return world.rotation(2, 2) > std::sqrt(0.5); }

// A place on the ground: [x, y] in calibration axes if z points up; a 3-vector is always accepted.
Eigen::Vector2d ground_position(const YamlValue& value, const WorldFrame& world) {
  const std::vector<double> numbers = value.numbers();
  if (numbers.size() == 3) {
    return world_from_calibration(world, Eigen::Vector3d(numbers.data())).head<2>();
  }
  if (!z_is_up(world) || numbers.size() != 2) {
    value.fail(fmt::format("{} numbers", numbers.size()),
               z_is_up(world) ? "[x, y] or [x, y, z]" : "[x, y, z], for z is not up");
  }
  // The z for which (x, y, z) lies on the ground: row 2 of R p + t is zero.
  const Eigen::RowVector3d row = world.rotation.row(2);
  const double z = -(row.x() * numbers[0] + row.y() * numbers[1] + world.translation.z()) / row.z();
  return world_from_calibration(world, {numbers[0], numbers[1], z}).head<2>();
}

double ground_heading(const YamlValue& value, const WorldFrame& world) {
  Eigen::Vector3d ahead;
  if (value.is_list()) {
    ahead = vector3(value);
  } else if (z_is_up(world)) {
    const double angle = value.number();
    ahead = {std::cos(angle), std::sin(angle), 0};
  } else {
    value.fail(value.describe_found(), "a direction [x, y, z], for z is not up");
  }
  const Eigen::Vector3d ahead_world = world.rotation * ahead;
  if (!(ahead_world.head<2>().norm() > 1e-6)) {
    value.fail("a direction that does not lie along the ground", "a direction along the ground");
  }
  return std::atan2(ahead_world.y(), ahead_world.x());
}

std::optional<InitialState> read_initial(const YamlValue& root, const WorldFrame& world) {
  if (!root.has("initial")) return std::nullopt;
  const YamlValue value = root.at("initial");
  value.only_keys({"time", "position", "heading", "speed", "phase"});
  InitialState initial;
  if (value.has("time")) initial.time = value.at("time").number(0, 1e6);
  initial.position = ground_position(value.at("position"), world);
  initial.heading = ground_heading(value.at("heading"), world);
  if (value.has("speed")) initial.speed = value.at("speed").number(0, 15);
  if (value.has("phase")) initial.phase = value.at("phase").number(0, 1);
  return initial;
}

// The place on the ground that a camera sees in a pixel.
Eigen::Vector2d place_in_picture(const YamlValue& near, const std::vector<SceneCamera>& cameras) {
  const YamlValue name = near.at("camera"), feet = near.at("feet_px");
  const std::vector<double> pixel = feet.numbers(2);
  const auto camera = std::ranges::find(cameras, name.text(), &SceneCamera::name);
  if (camera == cameras.end()) name.fail(name.describe_found(), "the name of a camera");
  const Camera& sees = camera->camera;
  if (pixel[0] < 0 || pixel[1] < 0 || pixel[0] > sees.width_px || pixel[1] > sees.height_px)
    feet.fail(fmt::format("[{:g}, {:g}]", pixel[0], pixel[1]),
              fmt::format("a pixel of its pictures, {} x {}", sees.width_px, sees.height_px));
  const auto place = ground_point(sees, Eigen::Vector2d(pixel.data()));
  if (!place)
    feet.fail(fmt::format("[{:g}, {:g}]", pixel[0], pixel[1]),
              "a pixel in which the camera sees the ground");
  return place->head<2>();
}

std::optional<SubjectPlace> read_near(const YamlValue& root, const Scene& scene) {
  if (!root.has("subject") || !root.at("subject").is_map() || !root.at("subject").has("near"))
    return std::nullopt;
  const YamlValue value = root.at("subject").at("near");
  value.only_keys({"time", "position", "camera", "feet_px"});
  if (scene.initial) value.fail("'near' and 'initial'", "one of them");
  if (value.has("position") == value.has("feet_px"))
    value.fail(
        value.has("position") ? "'position' and 'feet_px'" : "neither 'position' nor 'feet_px'",
        "one of them");
  return SubjectPlace{value.at("time").number(0, 1e6),
                      value.has("position") ? ground_position(value.at("position"), scene.world)
                                            : place_in_picture(value, scene.cameras)};
}

Polygon read_polygon(const YamlValue& value) {
  Polygon polygon;
  for (const YamlValue& corner : value.items()) {
    polygon.emplace_back(Eigen::Vector2d(corner.numbers(2).data()));
  }
  if (polygon.size() < 3) {
    value.fail(fmt::format("{} corners", polygon.size()), "at least 3 corners");
  }
  return polygon;
}

// Reads a polygon, or a polygon with the times between which it is present.
Occluder read_occluder(const YamlValue& value) {
  if (!value.is_map()) return {.outline = read_polygon(value)};
  value.only_keys({"polygon", "from", "to"});
  Occluder occluder{.outline = read_polygon(value.at("polygon"))};
  if (value.has("from")) occluder.from = value.at("from").number(-1e6, 1e6);
  if (value.has("to")) occluder.to = value.at("to").number(std::max(-1e6, occluder.from), 1e6);
  return occluder;
}

void read_occluders(const YamlValue& root, std::vector<SceneCamera>& cameras) {
  if (!root.has("occluders")) return;
  const YamlValue occluders = root.at("occluders");
  std::vector<std::string> names;
  for (const SceneCamera& camera : cameras) names.push_back(camera.name);
  occluders.only_keys(names);
  for (SceneCamera& camera : cameras) {
    if (!occluders.has(camera.name)) continue;
    for (const YamlValue& occluder : occluders.at(camera.name).items()) {
      camera.occluders.push_back(read_occluder(occluder));
    }
  }
}

void read_range(const YamlValue& root, Scene& scene) {
  if (root.has("first_frame")) {
    scene.first_frame = root.at("first_frame").integer(0, kMostFrames);
  }
  if (root.has("last_frame")) {
    scene.last_frame = root.at("last_frame").integer(scene.first_frame, kMostFrames);
  }
}

}  // namespace

Scene read_scene(const fs::path& path) {
  if (is_video_file(path)) {
    throw InputError(
        describe({path.string(), 0, ""}, "a video",
                 "a scene, which names videos and cameras: 'walktrack init' writes it"));
  }
  const YamlValue root = YamlValue::from_file(path.string());
  root.only_keys({"cameras", "frame_rate", "ground", "gravity", "subject", "initial", "occluders",
                  "truth", "first_frame", "last_frame"});
  Scene scene;
  scene.file = fs::absolute(path).lexically_normal();
  const fs::path folder = scene.file.parent_path();
  scene.world = read_ground(root);
  scene.gravity = read_gravity(root, scene.world);
  scene.cameras = read_cameras(root.at("cameras"), folder, scene.world);
  if (root.has("frame_rate")) {
    scene.frame_rate = root.at("frame_rate").number(kSlowestRate, kFastestRate);
  }
  state_subject(root.has("subject") ? read_subject(root.at("subject"), folder) : StatedSubject{},
                scene);
  scene.initial = read_initial(root, scene.world);
  scene.near = read_near(root, scene);
  read_occluders(root, scene.cameras);
  if (root.has("truth")) scene.truth = existing_path(root.at("truth"), folder);
  read_range(root, scene);
  return scene;
}

std::vector<fs::path> files_of(const Scene& scene) {
  std::vector<fs::path> files{scene.file};
  for (const SceneCamera& camera : scene.cameras)
    files.insert(files.end(),
                 {camera.video, camera.calibration, camera.background, camera.keypoints.path});
  files.insert(files.end(), {scene.truth, scene.subject_file});
  std::erase(files, fs::path());
  return files;
}

std::vector<Polygon> occluders_at(const SceneCamera& camera, double time) {
  std::vector<Polygon> out;
  for (const Occluder& occluder : camera.occluders)
    if (time >= occluder.from && time <= occluder.to) out.push_back(occluder.outline);
  return out;
}

bool is_frame_pattern(const fs::path& path) {
  std::error_code ignored;  // a name that is too long is treated as missing
  return path.filename().string().find('%') != std::string::npos && !fs::exists(path, ignored);
}

}  // namespace io
}  // namespace walktrack
