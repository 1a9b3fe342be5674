#include "io/scene/render_file.h"

#include <map>

#include <fmt/format.h>

#include "core/conventions.h"
#include "io/archive/files.h"
#include "io/config/yaml.h"
#include "io/scene/scene.h"
#include "io/tables/motion_file.h"
#include "io/video/image_files.h"
#include "synth/walk/made_walk.h"

namespace walktrack {
inline namespace io {

namespace fs = std::filesystem;

namespace {

constexpr double kFar = 1000;                            // m
constexpr double kLongest = 24 * 3600;                   // s
constexpr int kSmallestPicture = 8;                      // px
constexpr double kWalkMargin = 0.25;                     // s
constexpr double kLargestKey = 9'007'199'254'740'991.0;  // of seeds and persons; exact as a double
constexpr double kLargestFocal = 1e6;                    // px

// Reads `key` into `target` if it is present.
void take(const YamlValue& map, const std::string& key, double low, double high, double& target) {
  if (map.has(key)) target = map.at(key).number(low, high);
}
void take(const YamlValue& map, const std::string& key, double low, double high,
          std::optional<double>& target) {
  if (map.has(key)) target = map.at(key).number(low, high);
}
void take(const YamlValue& map, const std::string& key, int low, int high, int& target) {
  if (map.has(key)) target = map.at(key).integer(low, high);
}
void take(const YamlValue& map, const std::string& key, bool& target) {
  if (!map.has(key)) return;
  const std::string text = map.at(key).text();
  if (text != "true" && text != "false")
    map.at(key).fail(fmt::format("'{}'", text), "true or false");
  target = text == "true";
}
void take_degrees(const YamlValue& map, const std::string& key, double limit_deg, double& target) {
  if (map.has(key)) target = rad_from_deg(map.at(key).number(-limit_deg, limit_deg));
}
void take_point(const YamlValue& map, const std::string& key,
                std::optional<Eigen::Vector3d>& target) {
  if (map.has(key)) target = Eigen::Vector3d(map.at(key).numbers(3).data());
}

void read_setting(const YamlValue& value, Setting& setting) {
  const std::map<std::string, Setting> known{
      {"room", Setting::kRoom}, {"field", Setting::kField}, {"studio", Setting::kStudio}};
  const auto found = known.find(value.text());
  if (found == known.end()) value.fail(value.describe_found(), "room, field or studio");
  setting = found->second;
}

void read_light(const YamlValue& value, Light& light) {
  value.only_keys({"azimuth_deg", "elevation_deg", "sun", "ambient", "shadows", "contact_shadows"});
  take_degrees(value, "azimuth_deg", 360, light.azimuth);
  take_degrees(value, "elevation_deg", 90, light.elevation);
  take(value, "sun", 0, 10, light.sun);
  take(value, "ambient", 0, 10, light.ambient);
  take(value, "shadows", light.shadows);
  take(value, "contact_shadows", light.contact_shadows);
}

void read_sensor(const YamlValue& value, RenderOptions& options) {
  value.only_keys(
      {"exposure", "noise", "flicker", "monochrome", "blur_samples", "shutter", "jpeg_quality"});
  take(value, "exposure", 0, 100, options.sensor.exposure);
  take(value, "noise", 0, 1, options.sensor.noise);
  take(value, "flicker", 0, 0.3, options.sensor.flicker);
  take(value, "monochrome", options.sensor.monochrome);
  take(value, "blur_samples", 1, 64, options.shutter.blur_samples);
  take(value, "shutter", 0, 1, options.shutter.open);
  take(value, "jpeg_quality", 0, 100, options.jpeg_quality);
}

RenderCamera read_camera(const YamlValue& value, const fs::path& folder) {
  value.only_keys({"name", "calibration", "size", "focal_px", "distortion", "position", "look_at",
                   "azimuth_deg", "distance", "height", "frame_rate", "start_frame", "delay"});
  RenderCamera camera;
  camera.name = value.at("name").name();
  if (value.has("calibration"))
    camera.calibration = resolved(folder, value.at("calibration").text());
  if (value.has("size")) {
    const auto size = value.at("size").items();
    if (size.size() != 2)
      value.at("size").fail(value.at("size").describe_found(), "[width, height]");
    camera.width_px = size[0].integer(kSmallestPicture, kMostPixelsAlongASide);
    camera.height_px = size[1].integer(kSmallestPicture, kMostPixelsAlongASide);
  }
  if (value.has("distortion")) camera.distortion = value.at("distortion").numbers();
  take(value, "focal_px", 1, kLargestFocal, camera.focal_px);
  take_point(value, "position", camera.position);
  take_point(value, "look_at", camera.look_at);
  take_degrees(value, "azimuth_deg", 360, camera.azimuth);
  take(value, "distance", 0.1, kFar, camera.distance);
  take(value, "height", 0.01, kFar, camera.height);
  take(value, "frame_rate", kSlowestRate, kFastestRate, camera.frame_rate);
  take(value, "start_frame", 0, 1'000'000, camera.start_frame);
  take(value, "delay", -kLongest, kLongest, camera.delay);
  return camera;
}

Thing read_thing(const YamlValue& value) {
  value.only_keys({"post", "box"});
  const Material material{Colour(0.55f, 0.53f, 0.5f), Colour(0.4f, 0.37f, 0.34f), Pattern::kMottled,
                          0.15};
  if (value.has("box")) {
    const auto n = value.at("box").numbers(6);
    return {BoxSolid{{n[0], n[1], n[2]}, {n[3], n[4], n[5]}}, material, true};
  }
  const auto n = value.at("post").numbers(4);
  if (n[2] <= 0 || n[3] <= 0)
    value.at("post").fail("a radius or height of 0 or less", "[x, y, radius, height], above 0");
  return {upright_cone({n[0], n[1], 0}, n[3], n[2], n[2]), material, true};
}

std::vector<TimeSpan> read_spans(const YamlValue& list) {
  std::vector<TimeSpan> out;
  for (const YamlValue& item : list.items()) {
    const auto span = item.numbers(2);
    if (span[1] < span[0]) item.fail(item.describe_found(), "[from, to], in that order");
    out.push_back({span[0], span[1]});
  }
  return out;
}

KeypointFaults read_keypoint_faults(const YamlValue& value) {
  value.only_keys({"noise", "dropout", "flips", "bias", "flipped", "missing"});
  KeypointFaults faults;
  take(value, "noise", 0, 1, faults.noise);
  take(value, "dropout", 0, 1, faults.dropout);
  take(value, "flips", 0, 1, faults.flips);
  take(value, "bias", -1, 1, faults.bias);
  if (value.has("flipped")) faults.flipped = read_spans(value.at("flipped"));
  if (value.has("missing")) faults.missing = read_spans(value.at("missing"));
  return faults;
}

Shape read_shape(const YamlValue& value) {
  value.only_keys({"girth", "head", "belly", "trousers", "skirt", "pack"});
  Shape shape;
  take(value, "girth", 0.5, 2, shape.girth);
  take(value, "head", 0.5, 2, shape.head);
  take(value, "belly", 0, 0.3, shape.belly);
  take(value, "trousers", 0, 0.2, shape.trousers);
  take(value, "skirt", 0, 1.5, shape.skirt);
  take(value, "pack", 0, 0.5, shape.pack);
  return shape;
}

// Reads the keys that the subject and other people have in common.
void read_looks(const YamlValue& value, FilmedWalker& walker) {
  if (value.has("shape")) walker.shape = read_shape(value.at("shape"));
  take(value, "height", 0.5, 2.5, walker.height);
  take(value, "mass", 5, 300, walker.mass);
  take(value, "clothes", 0, 1000, walker.clothes);
  take(value, "arms", walker.arms);
  take_degrees(value, "turn_deg", 360, walker.turn);
  take(value, "delay", -kLongest, kLongest, walker.delay);
  if (value.has("shift")) walker.shift = Eigen::Vector2d(value.at("shift").numbers(2).data());
}

// The subject for whom the walk is generated: with the walker's height, and with segment lengths
// that are not given to the tracker.
Subject walking_subject(const YamlValue& looks, const FilmedWalker& walker) {
  Subject subject;
  subject.height = walker.height.value_or(subject.height);
  if (!looks.has("lengths")) return subject;
  const YamlValue lengths = looks.at("lengths");
  lengths.only_keys({"thigh", "shank", "hip_width", "trunk"});
  const auto read = [&](const char* key, std::optional<double>& target) {
    take(lengths, key, 0.05, 1, target);
  };
  read("thigh", subject.lengths.thigh);
  read("shank", subject.lengths.shank);
  read("hip_width", subject.lengths.hip_width);
  read("trunk", subject.lengths.trunk);
  return subject;
}

// A walk over the duration of the scene and slightly more, because shutters open before a frame's
// time. `person` walks unless the walk names another person.
Motion read_walk(const YamlValue& value, const Subject& subject, double duration, uint64_t person) {
  value.only_keys({"speed", "step_length", "start", "heading_deg", "turn_deg_s", "phase",
                   "arm_swing", "limp", "step_width", "lean_deg", "straightest", "person"});
  MadeWalk walk;
  walk.person = person;
  if (value.has("person"))
    walk.person = static_cast<uint64_t>(value.at("person").number(0, kLargestKey));
  take(value, "speed", 0.2, 3, walk.speed);
  take(value, "step_length", 0.1, 2, walk.step_length);
  if (value.has("start")) walk.start = Eigen::Vector2d(value.at("start").numbers(2).data());
  take_degrees(value, "heading_deg", 360, walk.heading);
  take_degrees(value, "turn_deg_s", 180, walk.turn_rate);
  take(value, "phase", 0, 1, walk.phase);
  take(value, "arm_swing", 0, 3, walk.arm_swing);
  take(value, "limp", -0.5, 0.5, walk.limp);
  take(value, "step_width", -0.1, 0.5, walk.step_width);
  if (value.has("lean_deg")) walk.lean = rad_from_deg(value.at("lean_deg").number(-45, 45));
  take(value, "straightest", 0.8, 0.999, walk.straightest);
  walk.from = -kWalkMargin;
  walk.to = duration + kWalkMargin;
  return made_walk(make_body(subject, {.head = true, .arms = true}), walk);
}

GaitWalk read_gait(const YamlValue& value) {
  value.only_keys({"speed", "step_length", "start", "heading_deg", "speed_at"});
  GaitWalk walk;
  take(value, "speed", 0.2, 3, walk.plan.speed);
  take(value, "step_length", 0.1, 2, walk.plan.step_length);
  if (value.has("start")) walk.start = Eigen::Vector2d(value.at("start").numbers(2).data());
  take_degrees(value, "heading_deg", 360, walk.heading);
  if (!value.has("speed_at")) return walk;
  for (const YamlValue& item : value.at("speed_at").items()) {
    const auto change = item.numbers(2);
    const double earliest = walk.plan.changes.empty() ? 0 : walk.plan.changes.back().time;
    if (change[0] < earliest || change[1] <= 0)
      item.fail(item.describe_found(), "[time, speed], times ascending, speeds above 0");
    walk.plan.changes.push_back({change[0], change[1]});
  }
  return walk;
}

FilmedWalker read_other(const YamlValue& value, const fs::path& folder, double duration,
                        uint64_t person, std::vector<fs::path>& motions) {
  value.only_keys({"motion", "walk", "height", "mass", "clothes", "arms", "turn_deg", "delay",
                   "shift", "shape", "lengths"});
  FilmedWalker walker;
  walker.clothes = 1;
  read_looks(value, walker);
  if (value.has("walk")) {
    walker.motion = read_walk(value.at("walk"), walking_subject(value, walker), duration, person);
  } else {
    motions.push_back(resolved(folder, value.at("motion").text()));
    walker.motion = read_motion(motions.back());
  }
  return walker;
}

// Reads the subject and its walk, which is generated for `duration` (s).
void read_subject(const YamlValue& file, double duration, RenderFile& out) {
  Subject who;
  if (file.has("subject")) {
    file.at("subject").only_keys(
        {"height", "mass", "clothes", "arms", "turn_deg", "delay", "shift", "shape", "lengths"});
    read_looks(file.at("subject"), out.subject);
    who = walking_subject(file.at("subject"), out.subject);
  }
  if (file.has("walk")) {
    out.subject.motion = read_walk(file.at("walk"), who, duration, out.options.seed);
    out.options.duration = duration;
  }
  if (file.has("gait")) {
    if (file.has("walk")) file.at("gait").fail("both 'walk' and 'gait'", "one of them");
    out.gait = read_gait(file.at("gait"));
    out.options.duration = duration;
  }
}

}  // namespace

RenderFile read_render_file(const fs::path& path) {
  const YamlValue file = YamlValue::from_file(path.string());
  file.only_keys({"seed",    "frame_rate", "start",     "duration",
                  "setting", "light",      "sensor",    "background_frames",
                  "images",  "subject",    "walk",      "gait",
                  "cameras", "occluders",  "others",    "slope_deg",
                  "gloss",   "initial",    "keypoints", "truth"});
  const fs::path folder = fs::absolute(path).parent_path();
  RenderFile out;
  RenderOptions& options = out.options;
  if (file.has("seed"))
    options.seed = static_cast<uint64_t>(file.at("seed").number(0, kLargestKey));
  take(file, "frame_rate", kSlowestRate, kFastestRate, options.frame_rate);
  take(file, "start", -kLongest, kLongest, options.start);
  take(file, "duration", 0, kLongest, options.duration);
  if (file.has("setting")) read_setting(file.at("setting"), options.setting);
  if (file.has("light")) read_light(file.at("light"), options.light);
  if (file.has("sensor")) read_sensor(file.at("sensor"), options);
  take(file, "background_frames", 0, 100'000, options.background_frames);
  take(file, "gloss", 0, 1, options.gloss);
  take(file, "images", options.images);
  take_degrees(file, "slope_deg", 45, options.slope);
  take(file, "initial", options.state_initial);
  const double duration = options.duration.value_or(kDefaultWalkDuration);
  read_subject(file, duration, out);
  if (file.has("cameras")) {
    for (const YamlValue& item : file.at("cameras").items())
      options.cameras.push_back(read_camera(item, folder));
  }
  if (file.has("occluders")) {
    for (const YamlValue& item : file.at("occluders").items())
      options.occluders.push_back(read_thing(item));
  }
  if (file.has("others")) {
    uint64_t person = options.seed;
    for (const YamlValue& item : file.at("others").items())
      options.others.push_back(read_other(item, folder, duration, ++person, out.motions));
  }
  if (file.has("keypoints")) options.keypoints = read_keypoint_faults(file.at("keypoints"));
  if (file.has("truth")) {
    const YamlValue truth = file.at("truth");
    truth.only_keys({"labels", "flow", "depth"});
    take(truth, "labels", options.labels);
    take(truth, "flow", options.flow);
    take(truth, "depth", options.depth);
  }
  return out;
}

}  // namespace io
}  // namespace walktrack
