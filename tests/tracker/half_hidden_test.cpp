#include "tracker/detect/half_hidden.h"

#include <gtest/gtest.h>

#include "walked_scene.h"

namespace walktrack {
namespace {

class HalfHidden : public WalkedScene {
 protected:
  // Evidence against the subject in some columns of a frame and camera, sum over rows of trunk and
  // legs, nats.
  double against_subject(size_t frame, size_t camera, int from, int to) const {
    double sum = 0;
    for (int y = 90; y < 150; ++y)
      for (int x = from; x < to; ++x)
        sum -= log_ratio_at(window_[frame][camera].planes, Appearance::kTrunk, x, y);
    return sum;
  }
  void hide_occluders() {
    walktrack::hide_occluders(subject_->context(), walk_, kHiddenFrames, window_);
  }
};

TEST_F(HalfHidden, WhatIsInFrontOfTheSubjectIsNoEvidence) {
  constexpr int kColumn = 128;
  show(0.2, kVideoFrames, {{0, -4, 1}},
       [](size_t, CameraEvidence& seen) { hide_left_of(kColumn, seen); });
  const double before = against_subject(0, 0, kColumn - 12, kColumn - 2);
  ASSERT_GT(before, 500);
  hide_occluders();
  EXPECT_EQ(against_subject(0, 0, kColumn - 12, kColumn - 2), 0);
}

TEST_F(HalfHidden, OfASubjectWhoIsWholeEverythingIsEvidence) {
  show(0.2, kVideoFrames, {{0, -4, 1}});
  const std::vector<int32_t> before = window_[0][0].planes.prefix;
  hide_occluders();
  EXPECT_EQ(window_[0][0].planes.prefix, before);
}

TEST_F(HalfHidden, ACameraThatSeesTheWholeSubjectKeepsItsEvidence) {
  show(0.2, kVideoFrames, {{0, -4, 1}, {4, 0.5, 1}},
       [camera = 0](size_t, CameraEvidence& seen) mutable {
         if (camera++ % 2 == 0) hide_left_of(128, seen);
       });
  const std::vector<int32_t> hidden = window_[1][0].planes.prefix,
                             whole = window_[1][1].planes.prefix;
  hide_occluders();
  EXPECT_NE(window_[1][0].planes.prefix, hidden);
  EXPECT_EQ(window_[1][1].planes.prefix, whole);
}

}  // namespace
}  // namespace walktrack
