#include "tracker/smooth/image_information.h"

#include <gtest/gtest.h>

#include "core/rng.h"
#include "fixture.h"
#include "tracker/moves/mirror_legs.h"

namespace walktrack {
namespace {

using Eigen::MatrixXd;
using Eigen::VectorXd;

MatrixXd some_information(const FreeNumbers& free) {
  Rng rng(1, Purpose::kTest);
  const auto size = static_cast<Eigen::Index>(free.size());
  MatrixXd root(size, size);
  for (Eigen::Index k = 0; k < root.size(); ++k) root.data()[k] = rng.normal();
  return root * root.transpose();
}

TEST(ImageInformation, ComesBackAsItWas) {
  for (const Path path : {Path::kSpatial, Path::kSagittal}) {
    const FreeNumbers free = free_numbers(test_model(path));
    const MatrixXd information = some_information(free);
    EXPECT_LT((unpacked(free, {{}, {}, packed(free, information)}) - information).norm(), 1e-12);
  }
}

// The information about a change of the pose equals the mirrored information about the mirrored
// change.
TEST(ImageInformation, IsMirroredWithThePose) {
  const BodyModel model = test_model();
  const FreeNumbers free = free_numbers(model);
  Pose pose, changed;
  Rng rng(2, Purpose::kTest);
  for (const size_t i : free) {
    kPoseNumbers[i].in(pose) = 0.1 + 0.05 * rng.uniform();
    kPoseNumbers[i].in(changed) = kPoseNumbers[i].in(pose) + 0.05 * rng.uniform();
  }
  ImageInformation images{pose, pose, packed(free, some_information(free))};
  const auto says = [&](const Pose& from, const Pose& to) {
    const VectorXd d = difference(free, from, to);
    return d.dot(unpacked(free, images) * d);
  };
  const double before = says(pose, changed);
  const std::vector<double> information = images.information;
  mirror_information(images);
  EXPECT_NEAR(says(mirrored_legs(model.body, pose), mirrored_legs(model.body, changed)), before,
              1e-9 * before);
  EXPECT_NE(images.information, information);
  mirror_information(images);
  EXPECT_EQ(images.information, information);
}

TEST(ImageInformation, NothingIsMirroredOfFramesThatWereNotAsked) {
  ImageInformation images;
  mirror_information(images);
  EXPECT_TRUE(images.information.empty());
}

}  // namespace
}  // namespace walktrack
