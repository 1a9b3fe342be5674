// The likelihood on the real side view (../shared/data/sports2d_side, if it exists) around a pose
// that was set by hand: joints were marked in two frames, between which they move uniformly.
#include <filesystem>
#include <map>
#include <string>
#include <utility>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/imgcodecs.hpp>

#include "observation/background/background_sampler.h"
#include "observation/shrink.h"
#include "tests/observation/perturbed.h"
#include "tests/observation/picture_terms.h"
#include "tests/observation/rendered.h"
#include "tests/observation/scenes.h"

namespace walktrack {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// The woman walks to the left in the image and shows her left side. Points were marked in an
// enlarged part of the image, to about 3 cm.
constexpr double kEnlarged = 2.5;
const Vector2d kCorner(802, 480);  // px, of the part
struct Mark {
  Joint joint;
  double left;          // m, distance of her left side from the plane of the walk
  Vector2d at54, at58;  // px of the enlarged part, in frames 54 and 58
};
const std::vector<Mark> kMarks{
    {Joint::kPelvis, 0, {825, 600}, {735, 600}},
    {Joint::kNeck, 0, {865, 245}, {775, 250}},
    {Joint::kHead, 0, {830, 160}, {738, 160}},
    {Joint::kLeftHip, 0.08, {825, 600}, {735, 600}},
    {Joint::kLeftKnee, 0.08, {828, 840}, {775, 835}},
    {Joint::kLeftAnkle, 0.08, {848, 1080}, {845, 1085}},
    {Joint::kLeftToe, 0.08, {785, 1118}, {788, 1122}},
    {Joint::kRightHip, -0.08, {825, 600}, {735, 600}},
    {Joint::kRightKnee, -0.08, {708, 815}, {600, 800}},
    {Joint::kRightAnkle, -0.08, {915, 985}, {605, 1055}},
    {Joint::kRightToe, -0.08, {878, 1065}, {528, 1075}},
};

Vector3d placed(const Camera& camera, const Vector2d& mark, double left) {
  const Ray ray = unproject(camera, kCorner + mark / kEnlarged).value();
  return ray.origin + (left - ray.origin.y()) / ray.direction.y() * ray.direction;
}

JointPositions placed_pose(const Camera& camera, int frame) {
  JointPositions out;
  const double share = (frame - 54) / 4.0;
  for (const Mark& mark : kMarks)
    out[mark.joint] = placed(camera, mark.at54 + share * (mark.at58 - mark.at54), mark.left);
  return out;
}

class SideView : public testing::Test {
 protected:
  void SetUp() override {
    if (!std::filesystem::exists(folder_ / "video.mp4"))
      GTEST_SKIP() << "needs " << folder_ << ", which is not here";
    camera_ = read_camera(folder_ / "side.yaml");
    frames_ = read_frames(folder_ / "video.mp4", 59);
    background_ = cv::imread((folder_ / "background.png").string());
  }
  // Share of the changed poses that are less likely than the set one, and the best shift along the
  // walk, m.
  std::pair<double, double> judged(const ObservationConfig& config) const;

  std::filesystem::path folder_ = shared_data() / "sports2d_side";
  Camera camera_;
  std::vector<cv::Mat> frames_;
  cv::Mat background_;
};

std::pair<double, double> SideView::judged(const ObservationConfig& config) const {
  constexpr int kShrink = 3;  // 416 px of woman to at least 120
  const Body body = make_body({1.65, 55, {}}, {});
  BackgroundSampler sampler(config.background);
  sampler.add(shrunk(background_, kShrink));
  Observer observer(config, {camera_, kShrink, appearances_of(body), sampler.model(), {}});
  const auto capsules = [&](const JointPositions& joints) {
    return project_parts(observer.camera(), pose_parts(body, skeleton_from_joints(body, joints)));
  };
  CameraEvidence evidence;
  Share share;
  std::map<int, double> along;  // sums over frames, by cm
  for (int f = 54; f <= 58; ++f) {
    const JointPositions pose = placed_pose(camera_, f);
    const Vector2d place = pose[Joint::kPelvis].head<2>();
    observer.observe(shrunk(frames_[static_cast<size_t>(f)], kShrink),
                     person_region(observer.camera(), place, 1.65, 0.7), evidence);
    if (f > 55) {
      const CapsuleList before = capsules(placed_pose(camera_, f - 1));
      const auto score = [&](const Change& change) {
        JointPositions other = pose;
        change(other);
        return log_likelihood(config, evidence, capsules(other), &before);
      };
      const double best = score(shifted(Vector3d::Zero()));
      for (const Change& change : changes(0.06, 0.2)) {
        share.won += score(change) < best;
        ++share.asked;
      }
      for (int cm = -15; cm <= 15; ++cm) along[cm] += score(shifted({0.01 * cm, 0, 0}));
    }
    observer.learn(evidence, capsules(pose));
  }
  int peak = 0;
  for (const auto& [cm, sum] : along)
    if (sum > along[peak]) peak = cm;
  return {share.value(), 0.01 * peak};
}

// 6 cm and 11 degrees are twice the accuracy of the marks. Measured: with all terms 0.93 of the
// changed poses are less likely, 0.98 with colours, 0.88 with the background, 0.93 with flow; the
// best is 0 to 2 cm in front.
TEST_F(SideView, ThePlacedPoseBeatsShiftedOnesForEachTermAndTogether) {
  const ObservationConfig all = every_term();
  ObservationConfig foreground, background, flow = all;
  foreground.background.enabled = background.foreground.enabled = false;
  flow.foreground.enabled = flow.background.enabled = false;
  const std::vector<std::pair<ObservationConfig, double>> least{
      {all, 0.88}, {foreground, 0.88}, {background, 0.8}, {flow, 0.85}};
  for (const auto& [config, least_share] : least) {
    const auto [share, peak] = judged(config);
    EXPECT_GT(share, least_share);
    EXPECT_NEAR(peak, 0, 0.03);
  }
}

}  // namespace
}  // namespace walktrack
