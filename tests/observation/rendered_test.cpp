// The likelihood on walks rendered by an independent program with other bodies.
#include "tests/observation/rendered.h"
#include "tests/observation/picture_terms.h"

#include <gtest/gtest.h>

#include "observation/background/background_sampler.h"
#include "tests/observation/perturbed.h"
#include "tests/observation/scenes.h"

namespace walktrack {
namespace {

// 4 cm, and 10 degrees (7 cm at the end of a thigh).
std::vector<Change> small_changes() { return changes(0.04, 0.17); }

// How often the true pose is more likely than a changed one, over the frames 6, 14, 22 ... of a
// side view.
Share true_pose_wins(const std::filesystem::path& folder, const ObservationConfig& config) {
  const Camera camera = read_camera(folder / "cam0.yaml");
  const std::vector<JointPositions> truth = read_truth(folder / "truth.csv");
  const Body body = make_body({1.71, 70, {}}, {});
  BackgroundSampler sampler(config.background);
  for (const cv::Mat& frame : read_frames(folder / "cam0_background.mp4", 8)) sampler.add(frame);
  Observer observer(config, {camera, 1, appearances_of(body), sampler.model(), {}});
  const auto capsules = [&](const JointPositions& joints) {
    return project_parts(observer.camera(), pose_parts(body, skeleton_from_joints(body, joints)));
  };
  const std::vector<cv::Mat> frames = read_frames(folder / "cam0.mp4", 46);
  CameraEvidence evidence;
  Share share;
  for (size_t f = 0; f < frames.size(); ++f) {
    const Eigen::Vector2d place = truth[f][Joint::kPelvis].head<2>();
    observer.observe(frames[f], person_region(observer.camera(), place, 1.75, 0.7), evidence);
    const CapsuleList now = capsules(truth[f]);
    if (f % 8 == 6) {
      const CapsuleList before = capsules(truth[f - 1]);
      const double best = log_likelihood(config, evidence, now, &before);
      for (const Change& change : small_changes()) {
        JointPositions other = truth[f];
        change(other);
        share.won += log_likelihood(config, evidence, capsules(other), &before) < best;
        ++share.asked;
      }
    }
    observer.learn(evidence, now);
  }
  return share;
}

class Rendered : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder_ / "truth.csv"))
      GTEST_SKIP() << "needs " << folder_ << ", which is not here";
  }
  std::filesystem::path folder_ = shared_data() / "rendered/cmu_02_01";
};

// Limits are the measured shares minus a margin for small changes of the models.
TEST_F(Rendered, TruePoseBeatsPerturbedPosesForEachTermAndTogether) {
  const ObservationConfig all = every_term();
  ObservationConfig foreground, background, flow = all;
  foreground.background.enabled = background.foreground.enabled = false;
  flow.foreground.enabled = flow.background.enabled = false;
  const double together = true_pose_wins(folder_, all).value();
  const double by_foreground = true_pose_wins(folder_, foreground).value();
  const double by_background = true_pose_wins(folder_, background).value();
  const double by_flow = true_pose_wins(folder_, flow).value();
  RecordProperty("together", std::to_string(together));
  RecordProperty("foreground", std::to_string(by_foreground));
  RecordProperty("background", std::to_string(by_background));
  RecordProperty("flow", std::to_string(by_flow));
  EXPECT_GT(together, 0.98);
  EXPECT_GT(by_foreground, 0.9);
  EXPECT_GT(by_background, 0.9);
  EXPECT_GT(by_flow, 0.9);
}

}  // namespace
}  // namespace walktrack
