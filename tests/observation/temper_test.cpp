// Whether the weights of terms match their information (lib/observation/reports/weights.md), on
// walks rendered by an independent program. At the true pose the variance of a log-likelihood's
// slopes matches its curvature,
//   E[(sum of slopes)^2] = -E[sum of second derivatives];
// the quotient of the right side by the left is the factor by which the weight of the term might be
// larger.
#include <functional>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "observation/background/background_sampler.h"
#include "observation/shrink.h"
#include "tests/observation/perturbed.h"
#include "tests/observation/picture_terms.h"
#include "tests/observation/rendered.h"
#include "tests/observation/scenes.h"

namespace walktrack {
namespace {

// A degree of freedom, changed by a number of its steps: 2 cm, or 4 degrees.
using Freedom = std::function<void(JointPositions&, double steps)>;

std::vector<Freedom> freedoms() {
  constexpr double kShift = 0.02, kTurn = 0.07;
  std::vector<Freedom> out;
  for (const Eigen::Vector3d& way : {Eigen::Vector3d(kShift, 0, 0), Eigen::Vector3d(0, 0, kShift)})
    out.push_back([way](JointPositions& j, double steps) { shifted(steps * way)(j); });
  out.push_back([](JointPositions& j, double steps) {
    turn(j, {Joint::kNeck, Joint::kHead}, Joint::kPelvis, steps * kTurn);
  });
  for (const Side side : {Side::kLeft, Side::kRight}) {
    out.push_back([side](JointPositions& j, double steps) {
      turn(j, {knee(side), ankle(side), toe(side)}, hip(side), steps * kTurn);
    });
    out.push_back([side](JointPositions& j, double steps) {
      turn(j, {ankle(side), toe(side)}, knee(side), steps * kTurn);
    });
  }
  return out;
}

// For one camera and one degree of freedom, frame by frame; nats per step, per step squared.
struct Derivatives {
  std::vector<double> slopes, curvatures;
};

std::vector<Derivatives> derivatives(const std::filesystem::path& walk, const std::string& name,
                                     const ObservationConfig& config) {
  constexpr int kShrink = 2;
  constexpr size_t kLearning = 8, kFrames = 68;
  const std::vector<JointPositions> truth = read_truth(walk / "truth.csv");
  const Body body = make_body({1.72, 70, {}}, {});
  BackgroundSampler sampler(config.background);
  for (const cv::Mat& frame : read_frames(walk / (name + "_background.mp4"), 8))
    sampler.add(shrunk(frame, kShrink));
  Observer observer(
      config,
      {read_camera(walk / (name + ".yaml")), kShrink, appearances_of(body), sampler.model(), {}});
  const auto capsules = [&](const JointPositions& joints) {
    return project_parts(observer.camera(), pose_parts(body, skeleton_from_joints(body, joints)));
  };
  const std::vector<cv::Mat> frames = read_frames(walk / (name + ".mp4"), kFrames);
  const std::vector<Freedom> moved = freedoms();
  std::vector<Derivatives> out(moved.size());
  CameraEvidence evidence;
  for (size_t f = 0; f < frames.size(); ++f) {
    const Eigen::Vector2d place = truth[f][Joint::kPelvis].head<2>();
    observer.observe(shrunk(frames[f], kShrink), person_region(observer.camera(), place, 1.75, 0.7),
                     evidence);
    const CapsuleList now = capsules(truth[f]);
    for (size_t d = 0; f >= kLearning && d < moved.size(); ++d) {
      const CapsuleList before = capsules(truth[f - 1]);
      const auto at = [&](double steps) {
        JointPositions joints = truth[f];
        moved[d](joints, steps);
        return log_likelihood(config, evidence, capsules(joints), &before);
      };
      const double ahead = at(1), behind = at(-1);
      out[d].slopes.push_back((ahead - behind) / 2);
      out[d].curvatures.push_back(ahead + behind - 2 * at(0));
    }
    observer.learn(evidence, now);
  }
  return out;
}

// The factor, with `window` frames taken together as one observation.
double factor(const std::vector<Derivatives>& all, size_t window) {
  double scatter = 0, curvature = 0;
  for (const Derivatives& one : all) {
    for (size_t begin = 0; begin + window <= one.slopes.size(); begin += window) {
      double slope = 0;
      for (size_t i = begin; i < begin + window; ++i) {
        slope += one.slopes[i];
        curvature -= one.curvatures[i];
      }
      scatter += slope * slope;
    }
  }
  return curvature / scatter;
}

class Temper : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder_))
      GTEST_SKIP() << "needs " << folder_ << ", which is not here";
  }
  std::vector<Derivatives> of(const ObservationConfig& config) const {
    std::vector<Derivatives> all;
    for (const char* walk : {"cmu_02_01", "bandai_1_walk_old_001"})
      for (const char* camera : {"cam0", "cam1"})
        for (Derivatives& one : derivatives(folder_ / walk, camera, config))
          all.push_back(std::move(one));
    return all;
  }
  const std::filesystem::path folder_ = shared_data() / "rendered";
};

// Errors that last a tenth of a second make a patch of `independent_m` one pixel. The errors of a
// body with another shape last longer, so that several frames contain less information than the sum
// of theirs.
TEST_F(Temper, SilhouettesWeighWhatATenthOfASecondKnows) {
  const std::vector<Derivatives> all = of({});
  EXPECT_GT(factor(all, 1), 2);
  EXPECT_GT(factor(all, 3), 0.9);
  EXPECT_LT(factor(all, 3), 2.5);
  EXPECT_LT(factor(all, 10), 1);
}

// The frames of a third of a second contain as much information as they are weighted with.
TEST_F(Temper, FlowWeighsWhatAThirdOfASecondKnows) {
  ObservationConfig flow = every_term();
  flow.foreground.enabled = flow.background.enabled = false;
  const std::vector<Derivatives> all = of(flow);
  EXPECT_GT(factor(all, 3), 1.5);
  EXPECT_GT(factor(all, 10), 0.7);
  EXPECT_LT(factor(all, 10), 2);
}

}  // namespace
}  // namespace walktrack
