// What the frames of one scene share, and what the images of one frame say about a pose.
#pragma once

#include <optional>
#include <vector>

#include "camera/camera.h"
#include "observation/likelihood.h"
#include "observation/observer.h"
#include "tracker/particle.h"
#include "tracker/sighting.h"

namespace walktrack {

struct TrackerScene {
  std::vector<Camera> cameras;  // of the images that the evidence is about (Observer::camera)
  BodyModel model;
  ObservationConfig observation;
  double dt = 1.0 / 30;             // s between frames
  std::optional<Sighting> initial;  // where the walk starts; without it, it is searched for
  int initial_frame = 0;
  std::optional<double> initial_phase;  // of the stride, 0 = left foot strike
};

// By camera, in the order of TrackerScene::cameras.
using SceneEvidence = std::vector<CameraEvidence>;

// Log-likelihood of a particle's pose and, `with_motion`, of its motion since the frame before,
// nats.
double log_likelihood(const TrackerScene& scene, const SceneEvidence& evidence,
                      const WalkerParticle& particle, bool with_motion);

// The same of the upright figure over a ground point that resembles the walker most.
double place_score(const TrackerScene& scene, const SceneEvidence& evidence,
                   const Eigen::Vector2d& position, double heading);

}  // namespace walktrack
