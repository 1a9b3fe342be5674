// Renderer and likelihood share no code, so each is the other's check: on noise-free pictures of
// the tracker's own body the likelihood of two cameras is greatest at the truth, for each degree of
// freedom that two views can see. Two views hardly see a hip's rotation: its 6 degrees cost some 10
// nats where those of hip flexion cost 500. It is held to 3 degrees.
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "body/kinematics.h"
#include "core/conventions.h"
#include "observation/capsules.h"
#include "observation/likelihood.h"
#include "synth/sensor.h"
#include "synth/view.h"
#include "tests/observation/scenes.h"

namespace walktrack {
namespace {

Pose striding_pose() {
  Pose pose;
  pose.root = {0, 0, 0.91};
  pose.heading = 0.05;
  pose.list = 0.04;
  pose.tilt = 0.07;
  pose.legs[0] = {0.45, 0.03, 0.02, 0.15, 0.05};
  pose.legs[1] = {-0.2, 0.02, 0, 0.5, -0.1};
  pose.arms[0] = {-0.3, 0.12, 0.4};
  pose.arms[1] = {0.3, 0.12, 0.5};
  return pose;
}

// Two cameras that have seen the empty studio, the walker a frame ago, and the walker in that pose.
class TwoCameras {
 public:
  explicit TwoCameras(const Pose& truth) {
    light_.shadows = false;  // the likelihood knows no shadows
    world_ = make_world(Setting::kStudio, {0, 0}, 6, light_, 5);
    Pose before = truth;
    before.root.x() -= 0.04;
    before.legs[0].hip_flexion += 0.06;
    before.legs[1].hip_flexion -= 0.06;
    for (const Camera& camera :
         {camera_at({0, -5, 1.2}, {0, 0, 0.9}, 620), camera_at({4, -3.5, 1.8}, {0, 0, 0.9}, 640)})
      film(camera, before, truth);
  }

  double log_likelihood_of(const Pose& pose) const {
    double sum = 0;
    for (size_t i = 0; i < cameras_.size(); ++i)
      sum += log_likelihood(config_, evidence_[i], capsules(cameras_[i], pose), nullptr);
    return sum;
  }

 private:
  std::vector<PosedPart> parts(const Pose& pose) const {
    std::vector<PosedPart> out;
    pose_parts(body_, forward_kinematics(body_, pose), out);
    return out;
  }
  CapsuleList capsules(const Camera& camera, const Pose& pose) const {
    return project_parts(camera, parts(pose));
  }
  cv::Mat noise_free(const View& view, const Plane<Colour>& light) const {
    std::vector<uint8_t> bytes =
        developed(light, {.exposure = 1, .noise = 0, .flicker = 0}, 1, 0, 0);
    return cv::Mat(view.camera.height_px, view.camera.width_px, CV_8UC3, bytes.data()).clone();
  }
  cv::Mat shot(const View& view, const Pose& pose) const {
    const std::vector<DressedParts> walkers{dress(parts(pose), worn_)};
    return noise_free(view, render(view, world_, walkers).colour);
  }
  void film(const Camera& camera, const Pose& before, const Pose& now) {
    constexpr int kShrink = 2;
    const View view = make_view(world_, camera, 2);
    BackgroundSampler sampler(config_.background, kShrink);
    sampler.add(noise_free(view, view.empty));
    Observer observer(config_, {camera, kShrink, appearances_of(body_), sampler.model(), {}});
    const Region all = whole_image(observer.camera(), 0.02);
    CameraEvidence evidence;
    observer.observe(shot(view, before), all, evidence);
    observer.learn(evidence, capsules(observer.camera(), before));
    observer.observe(shot(view, now), all, evidence);
    cameras_.push_back(observer.camera());
    evidence_.push_back(std::move(evidence));
  }

  Body body_ = make_body(Subject{}, {.head = true, .arms = true});
  Clothes worn_ = clothes(0);
  ObservationConfig config_;
  Light light_;
  World world_;
  std::vector<Camera> cameras_;
  std::vector<CameraEvidence> evidence_;
};

struct Freedom {
  std::string name;
  std::function<double&(Pose&)> of;
  double step, tolerance;  // m or rad
};

std::vector<Freedom> freedoms() {
  constexpr double kMillimetre = 0.001, kDegree = kPi / 180;
  std::vector<Freedom> out;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    out.push_back({"root " + std::to_string(axis),
                   [axis](Pose& p) -> double& { return p.root[axis]; }, kMillimetre,
                   5 * kMillimetre});
  const auto angle = [&](const std::string& name, std::function<double&(Pose&)> of,
                         double tolerance_deg) {
    out.push_back({name, std::move(of), 0.2 * kDegree, tolerance_deg * kDegree});
  };
  angle(
      "heading", [](Pose& p) -> double& { return p.heading; }, 1);
  angle(
      "list", [](Pose& p) -> double& { return p.list; }, 1);
  angle(
      "tilt", [](Pose& p) -> double& { return p.tilt; }, 1);
  for (const size_t s : {size_t{0}, size_t{1}}) {
    const std::string side = s == 0 ? "left " : "right ";
    angle(
        side + "hip flexion", [s](Pose& p) -> double& { return p.legs[s].hip_flexion; }, 1);
    angle(
        side + "hip abduction", [s](Pose& p) -> double& { return p.legs[s].hip_abduction; }, 1);
    angle(
        side + "hip rotation", [s](Pose& p) -> double& { return p.legs[s].hip_rotation; }, 3);
    angle(
        side + "knee", [s](Pose& p) -> double& { return p.legs[s].knee_flexion; }, 1);
    angle(
        side + "ankle", [s](Pose& p) -> double& { return p.legs[s].ankle_dorsiflexion; }, 1);
  }
  return out;
}

const TwoCameras& two_cameras() {
  static const TwoCameras film(striding_pose());
  return film;
}

TEST(LikelihoodMaximum, LiesAtTheTruthForEveryDegreeOfFreedom) {
  const Pose truth = striding_pose();
  const TwoCameras& film = two_cameras();
  for (const Freedom& freedom : freedoms()) {
    double best = -1e300, at = 0;
    for (int i = -30; i <= 30; ++i) {
      Pose pose = truth;
      freedom.of(pose) += i * freedom.step;
      const double value = film.log_likelihood_of(pose);
      if (value > best) {
        best = value;
        at = i * freedom.step;
      }
    }
    EXPECT_NEAR(at, 0, freedom.tolerance) << freedom.name;
  }
}

TEST(LikelihoodMaximum, TellsTheLegsApart) {
  const TwoCameras& film = two_cameras();
  Pose exchanged = striding_pose();
  std::swap(exchanged.legs[0], exchanged.legs[1]);
  EXPECT_GT(film.log_likelihood_of(striding_pose()), film.log_likelihood_of(exchanged) + 100);
}

}  // namespace
}  // namespace walktrack
