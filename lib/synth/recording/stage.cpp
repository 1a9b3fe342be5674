#include "synth/recording/stage.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "core/conventions.h"
#include "core/errors.h"

namespace walktrack {
inline namespace synth {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

constexpr double kLookAtHeight = 0.9;  // m; the middle of a walker
constexpr double kMargin = 0.6;        // m beside the path that a camera has to see
constexpr double kFieldWidths = 1.05;  // default focal length, in image widths
constexpr double kLongestGap = 2.5;    // sample periods; longer gaps of a motion are not
                                       // interpolated

// The path of a walk: the bounding box of the pelvis over the ground, and its overall direction.
struct Path {
  Vector2d low, high;
  double heading;
  Vector2d centre() const { return 0.5 * (low + high); }
  double reach() const { return 0.5 * (high - low).norm(); }
};

Motion placed(const FilmedWalker& walker, double start) {
  Motion motion = walker.motion;
  const Eigen::AngleAxisd turn(walker.turn, Vector3d::UnitZ());
  const Vector3d shift(walker.shift.x(), walker.shift.y(), 0);
  for (double& t : motion.time) t += walker.delay - start;
  for (JointPositions& joints : motion.joints)
    for (Vector3d& joint : joints.at) joint = turn * joint + shift;
  return motion;
}

Actor make_actor(const FilmedWalker& walker, double start) {
  Motion motion = placed(walker, start);
  Body body = body_from_motion(motion, height_of(walker));
  if (!walker.arms) body = make_body(body.subject, {.head = true, .arms = false});
  return {std::move(motion), shaped(std::move(body), walker.shape), clothes(walker.clothes)};
}

Motion at_times(const Actor& actor, std::span<const double> times) {
  return resampled(actor.motion, times, kLongestGap * sample_period(actor.motion));
}

Path path_of(const Motion& motion, double duration) {
  std::vector<Vector2d> points;
  for (size_t i = 0; i < motion.time.size(); ++i) {
    if (motion.time[i] < -1e-9 || motion.time[i] > duration + 1e-9) continue;
    const Vector3d pelvis =
        0.5 * (motion.joints[i][Joint::kLeftHip] + motion.joints[i][Joint::kRightHip]);
    if (known(pelvis)) points.push_back(pelvis.head<2>());
  }
  if (points.empty()) throw InputError("the motion has no row with both hips in the chosen time");
  Path path{points[0], points[0], 0};
  for (const Vector2d& point : points) {
    path.low = path.low.cwiseMin(point);
    path.high = path.high.cwiseMax(point);
  }
  const Vector2d way = points.back() - points.front();
  path.heading = std::atan2(way.y(), way.x());
  return path;
}

Camera look_at(Camera camera, const Vector3d& eye, const Vector3d& target) {
  const Vector3d ahead = (target - eye).normalized();
  const Vector3d right = ahead.cross(Vector3d::UnitZ()).normalized();
  camera.rotation << right.transpose(), ahead.cross(right).transpose(), ahead.transpose();
  camera.translation = -camera.rotation * eye;
  return camera;
}

Camera place_camera(const RenderCamera& wanted, const Path& path) {
  Camera camera;
  camera.width_px = wanted.width_px;
  camera.height_px = wanted.height_px;
  camera.focal_px.setConstant(wanted.focal_px.value_or(kFieldWidths * wanted.width_px));
  camera.centre_px = {0.5 * (wanted.width_px - 1), 0.5 * (wanted.height_px - 1)};
  if (!wanted.distortion.empty()) set_distortion(camera, wanted.distortion);
  const Vector3d middle(path.centre().x(), path.centre().y(), kLookAtHeight);
  const Vector3d target = wanted.look_at.value_or(middle);
  if (wanted.position) return look_at(camera, *wanted.position, target);
  // Horizontally the path's half length has to fit, vertically a person of two metres.
  const double half_width = 0.5 * wanted.width_px / camera.focal_px.x();
  const double half_height = 0.5 * wanted.height_px / camera.focal_px.y();
  const double fitting = std::max((path.reach() + kMargin) / half_width, 1.3 / half_height);
  const double angle = path.heading + wanted.azimuth;
  const double distance = wanted.distance.value_or(fitting);
  const Vector3d eye = middle + distance * Vector3d(std::cos(angle), std::sin(angle), 0);
  return look_at(camera, {eye.x(), eye.y(), wanted.height}, target);
}

double farthest_from(const Vector2d& centre, const std::vector<Camera>& cameras, double reach) {
  for (const Camera& camera : cameras)
    reach = std::max(reach, (camera_centre(camera).head<2>() - centre).norm());
  return reach;
}

}  // namespace

double height_of(const FilmedWalker& walker) {
  return walker.height.value_or(1e-3 * std::round(1e3 * stature_of(walker.motion)));
}

Stage make_stage(const FilmedWalker& walker, const RenderOptions& options,
                 const std::vector<std::optional<Camera>>& calibrated) {
  Stage stage;
  stage.actors.push_back(make_actor(walker, options.start));
  for (const FilmedWalker& other_walker : options.others)
    stage.actors.push_back(make_actor(other_walker, options.start));
  const Motion& motion = stage.actors.front().motion;
  stage.duration = options.duration.value_or(motion.time.back());
  const Path path = path_of(motion, stage.duration);
  for (size_t i = 0; i < options.cameras.size(); ++i) {
    const bool given = i < calibrated.size() && calibrated[i];
    stage.cameras.push_back(given ? *calibrated[i] : place_camera(options.cameras[i], path));
  }
  if (options.cameras.empty()) stage.cameras.push_back(place_camera({}, path));
  const double reach = farthest_from(path.centre(), stage.cameras, path.reach());
  stage.world = make_world(options.setting, path.centre(), reach, options.light, options.seed);
  stage.world.gloss = options.gloss;
  stage.world.things.insert(stage.world.things.end(), options.occluders.begin(),
                            options.occluders.end());
  return stage;
}

Motion truth_at(const Stage& stage, std::span<const double> times) {
  return at_times(stage.actors.front(), times);
}

JointPositions joints_at(const Actor& actor, double time) {
  return at_times(actor, std::span(&time, 1)).joints.front();
}

std::vector<DressedParts> actors_at(const Stage& stage, double time) {
  std::vector<DressedParts> out;
  for (const Actor& actor : stage.actors) {
    const auto skeleton = skeleton_from_joints(actor.body, joints_at(actor, time));
    out.push_back(dress(skeleton ? pose_parts(actor.body, *skeleton) : PosedParts{}, actor.worn));
  }
  return out;
}

Plane<Colour> exposed(const Stage& stage, const View& view, const Shutter& shutter, double time,
                      double frame_rate) {
  const int samples = std::max(1, shutter.blur_samples);
  Plane<Colour> sum;
  for (int k = 0; k < samples; ++k) {
    const double share = (k + 0.5) / samples - 0.5;
    const double instant = time + share * shutter.open / frame_rate;
    Picture picture = render(view, stage.world, actors_at(stage, instant));
    if (k == 0) {
      sum = std::move(picture.colour);
      continue;
    }
    for (size_t i = 0; i < sum.values.size(); ++i) sum.values[i] += picture.colour.values[i];
  }
  if (samples > 1) {
    for (Colour& colour : sum.values) colour /= static_cast<float>(samples);
  }
  return sum;
}

}  // namespace synth
}  // namespace walktrack
