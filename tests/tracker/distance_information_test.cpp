#include "tracker/smooth/distance_information.h"

#include <cmath>
#include <vector>

#include <gtest/gtest.h>
#include <Eigen/Eigenvalues>

#include "core/conventions.h"
#include "fixture.h"
#include "made_evidence.h"
#include "tests/observation/scenes.h"
#include "tracker/smooth/refinement.h"
#include "tracker/smooth/trajectory.h"

namespace walktrack {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr double kTooStiff = 1000, kTrue = 100;  // nats/m^2

// Smooth over decimetres, and rough over centimetres, along y, which is the line of sight.
double rough(const Pose& pose) {
  const double y = pose.root.y();
  return -0.5 * kTrue * y * y + 0.05 * std::cos(y * 2 * kPi / 0.02);
}

class DistanceInformation : public testing::Test {
 protected:
  MatrixXd found(const Pose& pose, const PoseLikelihood& likelihood = rough) const {
    return with_distance(camera, free, pose, likelihood, stiff());
  }
  // Every number is coupled with every other one.
  MatrixXd stiff() const {
    const auto size = static_cast<Eigen::Index>(free.size());
    return kTooStiff * (0.8 * MatrixXd::Identity(size, size) + MatrixXd::Constant(size, size, 0.2));
  }

  const BodyModel model = test_model();
  const FreeNumbers free = free_numbers(model);
  const Camera camera = camera_at({0, -4, 1}, {0, 0, 0.9}, 300, kEvidenceWidth, kEvidenceHeight);
};

TEST_F(DistanceInformation, IsThatOfPlacesFurtherApart) {
  const MatrixXd information = found(Pose{});
  EXPECT_NEAR(information(1, 1), kTrue, 1);
  // The other numbers keep their own.
  MatrixXd rest = information, before = stiff();
  for (MatrixXd* each : {&rest, &before}) {
    each->row(1).setZero();
    each->col(1).setZero();
  }
  EXPECT_LT((rest - before).norm(), 1e-9);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<MatrixXd>(information).eigenvalues()[0], 0);
}

TEST_F(DistanceInformation, IsNotLargerThanBefore) {
  EXPECT_EQ(found(Pose{}, [](const Pose& pose) { return 100 * rough(pose); }), stiff());
}

TEST_F(DistanceInformation, IsNoneIfTheImagesPreferBothSides) {
  const MatrixXd information = found(Pose{}, [](const Pose& pose) { return -rough(pose); });
  EXPECT_EQ(information(1, 1), 0);
  EXPECT_GT(Eigen::SelfAdjointEigenSolver<MatrixXd>(information).eigenvalues()[0], -1e-9);
}

TEST_F(DistanceInformation, StaysIfTheImagesKnowNoDistance) {
  const auto nothing = [](const Pose& pose) { return -rough(pose); };
  MatrixXd information = stiff();
  information.row(1).setZero();
  information.col(1).setZero();
  EXPECT_EQ(with_distance(camera, free, Pose{}, nothing, information), information);
}

TEST_F(DistanceInformation, IsTheSameWhereverTheFigureFaces) {
  const MatrixXd sideways = found(Pose{});
  ASSERT_NE(sideways, stiff());
  for (const double degrees : {30.0, 90.0, -90.0}) {
    Pose pose;
    pose.heading = rad_from_deg(degrees);
    EXPECT_EQ(found(pose), sideways) << degrees;
  }
}

// Somebody walks across the picture, and the particles of all frames are 12 cm too far away.
class DistanceOfATrajectory : public testing::Test {
 protected:
  static constexpr double kOff = 0.12, kWay = 0.04;  // m; m a frame
  // Mean distance of the trajectory from the truth, m.
  static double off(double standing) {
    TrackerScene scene = unseen(test_model(), 1.0 / 30);
    scene.cameras.push_back(
        camera_at({0, -4, 1}, {0, 0, 0.9}, 300, kEvidenceWidth, kEvidenceHeight));
    std::vector<FrameRecord> records;
    for (int t = 0; t < 20; ++t) {
      Pose truth;
      truth.root = {kWay * (t - 10), 0, 0.9};
      truth.legs[0] = {0.3 - 0.03 * t, 0.03, 0, 0.2, 0.05};
      truth.legs[1] = {-0.3 + 0.03 * t, 0.03, 0, 0.4, -0.1};
      const SceneEvidence evidence{evidence_of(scene.cameras[0], scene.model.body, truth)};
      Pose tracked = truth;
      tracked.root.y() += kOff;
      records.push_back(record_of(scene.model.body, tracked));
      records.back().modes.standing = standing;
      refine(scene, evidence, 1, records.back());
    }
    const auto poses = most_probable_trajectory(scene.model, {scene.dt, records}).poses;
    double sum = 0;
    for (const Pose& pose : poses) sum += pose.root.y() / static_cast<double>(poses.size());
    return sum;
  }
};

TEST_F(DistanceOfATrajectory, BeforeOneCameraIsWhatAllFramesShow) {
  EXPECT_LT(std::abs(off(0)), 0.3 * kOff);
}

TEST_F(DistanceOfATrajectory, StaysNearTheParticlesIfTheySayThatSomebodyStands) {
  EXPECT_GT(off(1), 0.4 * kOff);
}

}  // namespace
}  // namespace walktrack
