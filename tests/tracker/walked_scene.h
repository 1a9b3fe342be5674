// Somebody who walks along +x with the usual gait of a speed, seen without images.
#pragma once

#include <cmath>
#include <deque>
#include <functional>
#include <optional>
#include <vector>

#include <gtest/gtest.h>

#include "fixture.h"
#include "made_evidence.h"
#include "tests/observation/scenes.h"
#include "tracker/figure/girth.h"
#include "tracker/figure/trunk_length.h"
#include "tracker/tracked_subject.h"

namespace walktrack {

class WalkedScene : public testing::Test {
 protected:
  static constexpr double kSpeed = 1.3, kDt = 1.0 / 30;

  // `phase`: of the stride in the first frame. `places`: of the cameras. `hide`: changes a frame's
  // evidence of a camera.
  void show(double phase, size_t frames, const std::vector<Eigen::Vector3d>& places,
            const std::function<void(size_t frame, CameraEvidence&)>& hide = {}) {
    TrackerScene scene = unseen(test_model(), kDt);
    for (const Eigen::Vector3d& from : places)
      scene.cameras.push_back(camera_at(from, {0, 0, 0.9}, 200, kEvidenceWidth, kEvidenceHeight));
    const PriorGait gait = usual_gait(scene.model, prior_, kSpeed, 0);
    const Body wide = with_girth(scene.model.body, girth_);
    const Body person = with_trunk(wide, wide.lengths.trunk + longer_);
    window_.clear();
    poses_.clear();
    for (size_t t = 0; t < frames; ++t) {
      const double strides = phase + static_cast<double>(t) * kDt / (2 * gait.period);
      const double steps = 2 * (strides - std::floor(strides));
      Pose pose = pose_in_gait(scene.model, gait, steps < 1 ? Side::kLeft : Side::kRight,
                               steps - std::floor(steps));
      pose.root.head<2>() = walk_.position + static_cast<double>(t) * kDt * walk_.velocity;
      poses_.push_back(pose);
      SceneEvidence& frame = window_.emplace_back();
      for (const Camera& camera : scene.cameras) {
        frame.push_back(evidence_of(camera, person, pose));
        if (hide) hide(t, frame.back());
      }
    }
    subject_.emplace(scene, prior_, TrackerConfig{}, 1, 1);
  }

  // Before one camera at the side; in the first five frames something hides the columns left of
  // one.
  static constexpr size_t kVideoFrames = 44, kHiddenFrames = 5;
  void show_coming_out(double phase, int column) {
    show(phase, kVideoFrames, {{0, -4, 1}}, [column](size_t frame, CameraEvidence& evidence) {
      if (frame < kHiddenFrames) hide_left_of(column, evidence);
    });
  }

  GaitPrior prior_ = load_gait_prior();
  DetectedWalk walk_{.position = {-0.8, 0}, .velocity = {kSpeed, 0}};
  double girth_ = 1;         // of who walks there; the figure's is 1
  double longer_ = 0;        // m, their trunk than the figure's
  std::vector<Pose> poses_;  // the true ones
  std::deque<SceneEvidence> window_;
  std::optional<TrackedSubject> subject_;
};

}  // namespace walktrack
