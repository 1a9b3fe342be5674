#include "tests/bench/scenes.h"

#include <algorithm>
#include <cmath>

#include "body/kinematics.h"
#include "core/conventions.h"
#include "tests/camera/made_camera.h"
#include "tracker/motion/models/make_motion_model.h"
#include "tracker/motion/models/planar_body.h"
#include "tracker/start/start.h"

namespace walktrack {
namespace {

constexpr double kSpeed = 1.3;  // m/s, an adult's usual one
constexpr uint64_t kSeed = 1;

double rows_of(const CapsuleList& capsules, const PixelRect& area) {
  double rows = 0;
  for (const Capsule& c : capsules) {
    const double top =
        std::min(c.lower.centre.y() - c.lower.radius, c.upper.centre.y() - c.upper.radius);
    const double bottom =
        std::max(c.lower.centre.y() + c.lower.radius, c.upper.centre.y() + c.upper.radius);
    rows += std::max(0.0, std::min<double>(bottom, area.y1) - std::max<double>(top, area.y0));
  }
  return rows;
}

LogRatioPlanes blotched_planes(const PixelRect& area, int count) {
  LogRatioPlanes planes;
  resize(planes, area, count);
  for (int a = 0; a < kAppearanceCount; ++a) planes.plane_of[static_cast<size_t>(a)] = a % count;
  std::vector<float> row(static_cast<size_t>(area.width()));
  for (int y = area.y0; y < area.y1; ++y)
    for (int plane = 0; plane < count; ++plane) {
      for (size_t x = 0; x < row.size(); ++x)
        row[x] = std::sin(0.1F * static_cast<float>(static_cast<int>(x) + 3 * y + 50 * plane));
      set_row(planes, plane, y, row, 4);
    }
  return planes;
}

}  // namespace

WalkerCrowd walker_crowd(size_t count) {
  WalkerCrowd crowd;
  crowd.prior = load_gait_prior();
  crowd.parameters = adult_walker(1.75, 70);
  crowd.model = kneed_model(crowd.parameters);
  crowd.gait = gait_at(crowd.prior, crowd.parameters, kSpeed, 0.7);
  for (size_t i = 0; i < count; ++i) {
    Rng rng(kSeed, Purpose::kTest, 0, static_cast<uint32_t>(i));
    crowd.states.push_back(state_at_phase(crowd.model, crowd.gait, rng.uniform()));
    crowd.controls.push_back(draw_controls(rng, crowd.gait.controls, {}));
    crowd.torques.push_back(draw_torques(rng, crowd.gait.units, {}, 1.0 / 30));
  }
  return crowd;
}

FigureScene figure_scene(size_t poses) {
  FigureScene scene;
  scene.camera =
      looking_at(lens({640, 480}, {880, 880}, {319.5, 239.5}), {0, -3.4, 1.2}, {0, 0, 0.92});
  scene.body = make_body(Subject{}, {.head = true, .arms = false});
  scene.planes = blotched_planes({0, 0, 640, 480}, 3);
  const ParticleScene walkers = particle_scene(poses);
  for (const WalkerParticle& particle : walkers.particles) {
    Pose pose = particle.pose;
    pose.root.head<2>().setZero();
    scene.poses.push_back(pose);
    scene.capsules.push_back(
        project_parts(scene.camera, pose_parts(scene.body, forward_kinematics(scene.body, pose))));
    scene.mean_rows +=
        rows_of(scene.capsules.back(), scene.planes.area) / static_cast<double>(poses);
  }
  return scene;
}

ParticleScene particle_scene(size_t count) {
  BodyModel model;
  model.body = make_body(Subject{}, {.head = true, .arms = false});
  model.walker = kneed_model(kneed_parameters(Subject{}, kStandardGravity));
  const GaitPrior prior = load_gait_prior();
  ParticleScene scene{.model = model,
                      .prior = prior,
                      .moves = make_motion_model(MotionKind::kKneed, model, prior),
                      .config = {},
                      .particles = {}};
  StartConfig start;
  start.particles = static_cast<int>(count);
  const DetectedWalk sighting{.position = {0, 0}, .velocity = {kSpeed, 0}};
  scene.particles = spawn(scene.context(), start, sighting, {Side::kLeft, 0.0, 1.0}, kSeed);
  return scene;
}

}  // namespace walktrack
