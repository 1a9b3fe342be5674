#include "jobs/plan/plan.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "core/conventions.h"
#include "io/video/scene_video.h"
#include "jobs/check/check_sync.h"
#include "jobs/track/input/detections.h"
#include "jobs/track/input/learned_background.h"
#include "jobs/track/track_setup.h"
#include "tracker/modes/turning.h"
#include "tracker/walker_filter.h"

namespace walktrack {
inline namespace jobs {

namespace {

constexpr double kHundred = 100;

// The search box reaches half a metre beyond the limbs to all sides (kReach of
// jobs/track/track_run.cpp), seen obliquely, and a quarter of that above and below.
constexpr double kBoxWidth = 1.2, kBoxRise = 0.25;  // m

// Number of times that the pose network is run on a frame; 0 if there are keypoint files.
double looks_of(const SceneCamera& camera, const KeypointConfig& keypoints, double frame_rate) {
  if (!is_on(keypoints) || !camera.keypoints.path.empty() || camera.video.empty()) return 0;
  return 1.0 / frames_between_looks(keypoints, frame_rate);
}

CameraWork camera_work(const Scene& scene, const SceneCamera& camera, const Config& config) {
  const WorkingScale scale = working_scale(scene, camera.camera, config);
  const double rows = scale.person_px / scale.shrink, height = scene.subject.height;
  const double px_per_m = rows / height;
  const double image_height = static_cast<double>(camera.camera.height_px) / scale.shrink;
  const double image_width = static_cast<double>(camera.camera.width_px) / scale.shrink;
  return {camera.name, static_cast<double>(camera.camera.width_px) * camera.camera.height_px,
          std::min(image_width, kBoxWidth * px_per_m) *
              std::min(image_height, (height + kBoxRise) * px_per_m),
          std::min(image_height, rows),
          looks_of(camera, config.observation.keypoints, scene.frame_rate.value())};
}

int classes_of(const ObservationConfig& config, const Body& body) {
  if (!config.foreground.enabled) return 0;
  const auto used = appearances_of(body);
  std::set<int> classes;
  for (size_t i = 0; i < used.size(); ++i)
    if (used[i]) classes.insert(config.foreground.classes[i]);
  return static_cast<int>(classes.size());
}

FrameWork frame_work(const Scene& scene, const Config& config) {
  const Body body = make_body(scene.subject, config.body);
  const FilterConfig& filter = config.tracker.filter;
  FrameWork work;
  for (const SceneCamera& camera : scene.cameras)
    work.cameras.push_back(camera_work(scene, camera, config));
  work.particles = filter.particles;
  const double layers = usual_layers(static_cast<int>(scene.cameras.size()), filter.max_layers);
  work.poses = filter.particles * (1 + layers * filter.moves);
  MotionConfig motion = config.tracker.motion;
  if (config.budget.frame_ms > 0) motion.turning_yaw_rate_sd = 0;  // as TrackRun does
  if (const int beside = turning_components(motion, motion.path, scene.cameras.size());
      beside > 0) {
    work.particles *= 1 + beside;
    work.poses += beside * filter.particles * (1 + layers * component_config(filter).moves);
  }
  work.parts = static_cast<int>(body.parts.size());
  work.classes = classes_of(config.observation, body);
  work.terms = config.observation;
  return work;
}

double total_ms(const Scene& scene, const Config& config) {
  return frame_cost(frame_work(scene, config)).sum();
}

// Writes the items, each with the cost that it would save.
class Items {
 public:
  Items(const Scene& scene, const ConfigWithOrigin& config)
      : scene_(scene), config_(config), all_(total_ms(scene, config.values)) {}

  // An item that a flag of the configuration switches.
  void flag(const std::string& name, const std::string& key, bool on, const std::string& what) {
    PlanItem item{name, on, what, origin(key), 0};
    if (item.on) {
      ConfigWithOrigin without = config_;
      apply_setting(without, key + "=false", "");
      item.ms = all_ - total_ms(scene_, without.values);
    }
    items_.push_back(std::move(item));
  }

  // An item that follows from the scene.
  void fact(const std::string& name, bool on, const std::string& what, const std::string& why) {
    items_.push_back({name, on, what, why, 0});
  }

  std::string origin(const std::string& key) const {
    const auto found = config_.origin.find(key);
    return found == config_.origin.end() ? key + ", a default" : key + ", from " + found->second;
  }

  std::vector<PlanItem> take() { return std::move(items_); }

 private:
  const Scene& scene_;
  const ConfigWithOrigin& config_;
  double all_;
  std::vector<PlanItem> items_;
};

void add_walker(const Config& config, Items& items) {
  const auto item = [&](const char* name, const char* what) {
    items.fact(name, true, what, items.origin("motion.model"));
  };
  switch (config.tracker.motion.model) {
    case MotionKind::kKneed:
      return item("walker",
                  "a kneed walker simulated from frame to frame, with noise on its torques");
    case MotionKind::kAnthropomorphic:
      return item("walker",
                  "a walker with two straight legs; knees and trunk follow Markov processes");
    case MotionKind::kMarkov:
      return item("motion", "every coordinate follows a Markov process: no walker, no ground");
  }
}

double slope_deg(const Scene& scene) {
  return deg_from_rad(std::atan2(scene.gravity.head<2>().norm(), -scene.gravity.z()));
}

// Of the figure, where the first poses before one camera can show it (tracker/figure).
void add_shape(const Scene& scene, Items& items) {
  const bool one = scene.cameras.size() == 1 && !scene.cameras[0].video.empty();
  const auto fact = [&](const char* name, const char* what, bool open, const char* given) {
    items.fact(name, one && open, what,
               !one   ? "only for one camera with a video"
               : open ? "the scene leaves it open"
                      : given);
  };
  fact("girth", "the subject's girth, estimated if the first poses show that they are clearly wide",
       !scene.girth_given, "the scene gives subject.girth");
  const bool trunk_given = scene.subject.lengths.trunk.has_value();
  fact("trunk",
       "the length of the subject's trunk, estimated if the first poses show a clearly unusual one",
       scene.height_given && !trunk_given,
       trunk_given ? "the scene gives subject.lengths.trunk"
                   : "the scene does not give subject.height");
}

// What is estimated for the whole recording, where the scene leaves it open.
void add_recording(const Scene& scene, Items& items) {
  items.fact("size", !scene.height_given,
             "the subject's height, estimated from the first window in which the subject is found",
             scene.height_given ? "the scene gives subject.height"
             : scene.height_sd  ? "the scene gives subject.height_sd"
                                : "the scene does not give subject.height");
  add_shape(scene, items);
  const bool lag = starts_are_open(scene);
  items.fact("lag", lag, "the time between both cameras, estimated from the walk",
             lag                         ? "no camera has a start_frame"
             : scene.cameras.size() == 2 ? "the scene gives a start_frame"
                                         : "only for two cameras");
}

std::vector<PlanItem> items_of(const Scene& scene, const ConfigWithOrigin& config) {
  const Config& values = config.values;
  Items items(scene, config);
  add_walker(values, items);
  items.fact("legs, trunk", true, "tilt, hips, knees and ankles in the walk's upright planes",
             "always: the subject's body");
  items.fact("sideways", values.tracker.motion.path == Path::kSpatial,
             "turning, pelvic obliquity, hips moving sideways, 6 more angles",
             items.origin("motion.path"));
  items.flag("head", "body.head", values.body.head, "head and neck");
  items.flag("arms", "body.arms", values.body.arms, "both arms, 6 more angles");
  for (const TermSwitch& term : term_switches())
    items.flag(std::string(term.plan_name), fmt::format("observation.{}.enabled", term.key),
               term.on(values.observation), std::string(term.what));
  const bool slope = !scene.gravity.head<2>().isZero();
  items.fact("slope", slope,
             slope ? fmt::format("{:.1f} degrees", slope_deg(scene)) : "the ground is level",
             slope ? "the scene's gravity leans" : "the scene's gravity is upright");
  const auto hidden = std::count_if(scene.cameras.begin(), scene.cameras.end(),
                                    [](const SceneCamera& c) { return !c.occluders.empty(); });
  items.fact("occluders", hidden > 0, "pixels behind obstacles, which are left out",
             hidden > 0 ? fmt::format("{} of the scene's cameras have some", hidden)
                        : "the scene has none");
  const auto without = std::count_if(scene.cameras.begin(), scene.cameras.end(), learns_from_video);
  const bool left_out = leaves_people_out(scene, values);
  items.fact("bystanders", left_out,
             "people who stand are found by the pose network and left out of a background learned "
             "from the video",
             without == 0 ? "every camera has pictures of the empty scene"
                          : items.origin("observation.background.without_people"));
  items.fact("search", !scene.initial,
             "a search for the walk in a window of frames, until it is found",
             scene.initial ? "the scene says where the walk begins" : "the scene has no `initial`");
  add_recording(scene, items);
  const bool paced = values.budget.frame_ms > 0;
  items.fact(
      "budget", paced,
      paced ? fmt::format(
                  "{} to {} particles, depending on the time that frames take: not deterministic",
                  values.budget.least_particles, values.budget.most_particles)
            : "particles adapted to a time per frame",
      items.origin("budget.frame_ms"));
  return items.take();
}

std::vector<std::pair<std::string, double>> memory_of(const Scene& scene, const Config& config,
                                                      const Plan& plan) {
  double filmed = 0, shrunk = 0, region = 0;
  for (size_t c = 0; c < plan.cameras.size(); ++c) {
    const PlanCamera& camera = plan.cameras[c];
    const double pixels = plan.work.cameras[c].filmed_px;
    filmed += pixels;
    shrunk += pixels / (camera.shrink * camera.shrink);
    region += plan.work.cameras[c].region_px;
  }
  const ObservationConfig& images = config.observation;
  const StartConfig& start = config.tracker.start;
  const double hypotheses = 2.0 * start.phases * start.particles;
  std::vector<std::pair<std::string, double>> out{
      {"particles", plan.work.particles * plan.state.bytes_per_particle},
      {"start hypotheses of the first half second", hypotheses * plan.state.bytes_per_particle},
      {"frames as recorded", 2 * 3 * filmed},
      {"log-ratios around the subject", sizeof(int32_t) * region * std::max(1, plan.work.classes)}};
  if (images.background.enabled) {
    out.emplace_back("background", 5 * sizeof(float) * shrunk);
    out.emplace_back(
        "learning the background, before the first frame",
        (leaves_people_out(scene, config) ? 4.0 : 3.0) * images.background.samples * shrunk);
  }
  out.emplace_back("the window of frames in which a walk starts",
                   search_window_bytes(scene, config, plan.frame_rate));
  const double record =
      double{sizeof(FrameRecord)} + config.tracker.samples * double{sizeof(JointPositions)};
  out.emplace_back("results of a minute of video", 60 * plan.frame_rate * record);
  return out;
}

std::string saving(double without, double all) {
  return fmt::format("saves {:.0f} % of the time", kHundred * (1 - without / all));
}

// The camera that sees the walk most nearly from the side, if the scene states the direction of the
// walk.
std::optional<size_t> side_camera(const Scene& scene) {
  std::optional<size_t> best;
  double most = -1;
  for (size_t c = 0; c < scene.cameras.size(); ++c) {
    const auto view = side_view(scene, scene.cameras[c].camera);
    if (!view || view->off_sight <= most) continue;
    best = c;
    most = view->off_sight;
  }
  return best;
}

void advise_cameras(const Scene& scene, const Config& config, double all,
                    std::vector<std::string>& out) {
  if (scene.cameras.size() < 2) return;
  const std::optional<size_t> side = side_camera(scene);
  Scene one = scene;
  one.cameras = {scene.cameras[side.value_or(0)]};
  const double alone = total_ms(one, config);
  if (alone >= all) return;  // a track before one camera is checked against others
  out.push_back(fmt::format(
      "Cameras: speed, steps and sagittal angles need only one camera at the side{}; this {}. Step "
      "width, turning and the distance to the camera need a second one.",
      side ? fmt::format(" ({})", one.cameras[0].name) : "", saving(alone, all)));
}

std::vector<std::string> advice_of(const Scene& scene, const ConfigWithOrigin& config, double all) {
  std::vector<std::string> out;
  const Config& values = config.values;
  const auto without = [&](const std::string& setting) {
    ConfigWithOrigin changed = config;
    apply_setting(changed, setting, "");
    return saving(total_ms(scene, changed.values), all);
  };
  const ObservationConfig& images = values.observation;
  if (is_on(images.flow) && (images.background.enabled || images.foreground.enabled))
    out.push_back(
        fmt::format("Flow: silhouettes suffice for a subject who stands out from the background; "
                    "observation.flow.enabled=off {}.",
                    without("observation.flow.enabled=off")));
  if (is_on(images.keypoints) && scene.cameras.size() > cameras_in_doubt(scene))
    out.push_back(
        fmt::format("Keypoints: with {} cameras silhouettes alone suffice to tell left from right; "
                    "observation.keypoints.enabled=off {}.",
                    scene.cameras.size(), without("observation.keypoints.enabled=off")));
  if (values.body.arms)
    out.push_back(
        fmt::format("Arms: legs, pelvis and trunk are tracked without them; "
                    "body.arms=false {}.",
                    without("body.arms=false")));
  const double usual = ObservationConfig{}.person_px;
  if (images.person_px > usual)
    out.push_back(
        fmt::format("Scale: more than {:g} px of person height gain little accuracy; "
                    "observation.person_px={:g} {}.",
                    usual, usual, without(fmt::format("observation.person_px={:g}", usual))));
  const int usual_particles = particles_for(scene.cameras.size()).filter;
  if (values.tracker.filter.particles > usual_particles)
    out.push_back(fmt::format("Particles: filter.particles={} {}.", usual_particles,
                              without(fmt::format("filter.particles={}", usual_particles))));
  advise_cameras(scene, values, all, out);
  return out;
}

}  // namespace

Plan plan_scene(const Scene& given, const ConfigWithOrigin& wanted) {
  Scene scene = given;
  scene.frame_rate = SceneVideo(given).frame_rate();
  ConfigWithOrigin config = wanted;
  config.values = decided(scene, wanted.values);
  Plan plan;
  plan.scene = scene.file;
  plan.frame_rate = *scene.frame_rate;
  plan.work = frame_work(scene, config.values);
  plan.cost = frame_cost(plan.work);
  for (size_t c = 0; c < scene.cameras.size(); ++c) {
    const SceneCamera& camera = scene.cameras[c];
    const WorkingScale scale = working_scale(scene, camera.camera, config.values);
    plan.cameras.push_back({camera.name, camera.camera.width_px, camera.camera.height_px,
                            scale.shrink, scale.person_px / scale.shrink,
                            sum(plan.cost.cameras[c])});
  }
  plan.items = items_of(scene, config);
  plan.state = state_of(scene, config.values);
  plan.levels = plan_levels(scene, config);
  plan.memory = memory_of(scene, config.values, plan);
  plan.advice = advice_of(scene, config, plan.cost.sum());
  return plan;
}

}  // namespace jobs
}  // namespace walktrack
