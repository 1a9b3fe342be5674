// Renderer and likelihood share no code, so that each tests the other: on noise-free images of the
// tracker's own body the likelihood of two cameras has its maximum at the truth, for each degree of
// freedom that two views show. They hardly show a hip's rotation, which rotates a round thigh, nor
// the abduction of a shoulder, whose arm moves towards one camera and in front of the trunk for the
// other: six degrees cost 1 to 6 nats where those of hip flexion cost 80. These are tested to 3
// degrees.
#include <cmath>
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "body/kinematics.h"
#include "core/conventions.h"
#include "observation/background/background_sampler.h"
#include "observation/shrink.h"
#include "observation/silhouette/capsules.h"
#include "synth/recording/sensor.h"
#include "synth/recording/view.h"
#include "synth/world/settings.h"
#include "tests/observation/picture_terms.h"
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

// Two cameras that have seen the empty studio, the walker in the previous frame, and the walker in
// that pose.
class TwoCameras {
 public:
  explicit TwoCameras(const Pose& truth) {
    light_.shadows = false;  // the likelihood has no model of shadows
    world_ = make_world(Setting::kStudio, {0, 0}, 6, light_, 5);
    Pose before = truth;
    before.root.x() -= 0.04;
    before.legs[0].hip_flexion += 0.06;
    before.legs[1].hip_flexion -= 0.06;
    for (const Camera& camera :
         {camera_at({0, -5, 1.2}, {0, 0, 0.9}, 620), camera_at({4, -3.5, 1.8}, {0, 0, 0.9}, 640)})
      record(camera, before, truth);
  }

  double log_likelihood_of(const Pose& pose) const {
    double sum = 0;
    for (size_t i = 0; i < cameras_.size(); ++i)
      sum += log_likelihood(config_, evidence_[i], capsules(cameras_[i], pose), nullptr);
    return sum;
  }

 private:
  PosedParts parts(const Pose& pose) const {
    return pose_parts(body_, forward_kinematics(body_, pose));
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
  void record(const Camera& camera, const Pose& before, const Pose& now) {
    constexpr int kShrink = 2;
    const View view = make_view(world_, camera, 2);
    BackgroundSampler sampler(config_.background);
    sampler.add(shrunk(noise_free(view, view.empty), kShrink));
    Observer observer(config_, {camera, kShrink, appearances_of(body_), sampler.model(), {}});
    const Region all = whole_image(observer.camera(), 0.02);
    CameraEvidence evidence;
    observer.observe(shrunk(shot(view, before), kShrink), all, evidence);
    observer.learn(evidence, capsules(observer.camera(), before));
    observer.observe(shrunk(shot(view, now), kShrink), all, evidence);
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

constexpr double kMillimetre = 0.001, kDegree = kPi / 180;

struct Freedom {
  std::string name;
  std::function<double&(Pose&)> of;
  double step;       // m or rad, of the search
  double tolerance;  // m or rad
};

Freedom angle(const std::string& name, std::function<double&(Pose&)> of) {
  return {name, std::move(of), 0.2 * kDegree, kDegree};
}

// Those that two views show: to 5 mm and 1 degree.
std::vector<Freedom> seen_freedoms() {
  std::vector<Freedom> out;
  for (Eigen::Index axis = 0; axis < 3; ++axis)
    out.push_back({"root " + std::to_string(axis),
                   [axis](Pose& p) -> double& { return p.root[axis]; }, kMillimetre,
                   5 * kMillimetre});
  out.push_back(angle("heading", [](Pose& p) -> double& { return p.heading; }));
  out.push_back(angle("list", [](Pose& p) -> double& { return p.list; }));
  out.push_back(angle("tilt", [](Pose& p) -> double& { return p.tilt; }));
  for (const size_t s : {size_t{0}, size_t{1}}) {
    const auto of_leg = [&](const char* name, double LegPose::*member) {
      out.push_back(
          angle(name + std::to_string(s), [=](Pose& p) -> double& { return p.legs[s].*member; }));
    };
    of_leg("hip flexion ", &LegPose::hip_flexion);
    of_leg("hip abduction ", &LegPose::hip_abduction);
    of_leg("knee ", &LegPose::knee_flexion);
    of_leg("ankle ", &LegPose::ankle_dorsiflexion);
    out.push_back(angle("shoulder flexion " + std::to_string(s),
                        [s](Pose& p) -> double& { return p.arms[s].shoulder_flexion; }));
    out.push_back(angle("elbow " + std::to_string(s),
                        [s](Pose& p) -> double& { return p.arms[s].elbow_flexion; }));
  }
  return out;
}

std::vector<Freedom> hardly_seen_freedoms() {
  std::vector<Freedom> out;
  for (const size_t s : {size_t{0}, size_t{1}}) {
    out.push_back(angle("hip rotation " + std::to_string(s),
                        [s](Pose& p) -> double& { return p.legs[s].hip_rotation; }));
    out.push_back(angle("shoulder abduction " + std::to_string(s),
                        [s](Pose& p) -> double& { return p.arms[s].shoulder_abduction; }));
  }
  for (Freedom& freedom : out) freedom.tolerance = 3 * kDegree;
  return out;
}

const TwoCameras& two_cameras() {
  static const TwoCameras cameras(striding_pose());
  return cameras;
}

double log_likelihood_beside(const Freedom& freedom, double by) {
  Pose pose = striding_pose();
  freedom.of(pose) += by;
  return two_cameras().log_likelihood_of(pose);
}

void expect_maximum_at_truth(const Freedom& freedom) {
  double best = -1e300, at = 0;
  for (int i = -30; i <= 30; ++i) {
    const double value = log_likelihood_beside(freedom, i * freedom.step);
    if (value <= best) continue;
    best = value;
    at = i * freedom.step;
  }
  EXPECT_NEAR(at, 0, freedom.tolerance) << freedom.name;
}

TEST(LikelihoodMaximum, LiesAtTheTruthForEveryDegreeOfFreedom) {
  for (const Freedom& freedom : seen_freedoms()) expect_maximum_at_truth(freedom);
  for (const Freedom& freedom : hardly_seen_freedoms()) expect_maximum_at_truth(freedom);
}

// Six degrees from the truth.
double cost_of(const Freedom& freedom) {
  return log_likelihood_beside(freedom, 0) - 0.5 * (log_likelihood_beside(freedom, -6 * kDegree) +
                                                    log_likelihood_beside(freedom, 6 * kDegree));
}

TEST(LikelihoodMaximum, IsFlatInWhatTwoViewsHardlySee) {
  const double sharp = cost_of(angle("", [](Pose& p) -> double& { return p.legs[0].hip_flexion; }));
  for (const Freedom& freedom : hardly_seen_freedoms())
    EXPECT_LT(cost_of(freedom), 0.1 * sharp)
        << freedom.name << ": seen after all, hold it to 1 deg";
}

TEST(LikelihoodMaximum, TellsTheLegsApart) {
  const TwoCameras& cameras = two_cameras();
  Pose swapped = striding_pose();
  std::swap(swapped.legs[0], swapped.legs[1]);
  EXPECT_GT(cameras.log_likelihood_of(striding_pose()), cameras.log_likelihood_of(swapped) + 100);
}

}  // namespace
}  // namespace walktrack
