// Evidence of a camera, generated without images.
#pragma once

#include <cmath>
#include <vector>

#include "body/kinematics.h"
#include "observation/observer.h"
#include "observation/silhouette/silhouette.h"

namespace walktrack {

inline constexpr int kEvidenceWidth = 320, kEvidenceHeight = 240;

// Pixels that are evidence for a body with different strengths, and on request stripes that move to
// the right.
inline CameraEvidence made_evidence(double nats, bool flow) {
  CameraEvidence out;
  resize(out.planes, {0, 0, kEvidenceWidth, kEvidenceHeight}, 1);
  std::vector<float> row(kEvidenceWidth);
  for (int y = 0; y < kEvidenceHeight; ++y) {
    for (int x = 0; x < kEvidenceWidth; ++x)
      row[static_cast<size_t>(x)] = static_cast<float>(nats * ((x + 3 * y) % 17 - 8) / 8.0);
    set_row(out.planes, 0, y, row, 4);
  }
  if (!flow) return out;
  const auto stripes = [](int shift) {
    GreyImage image{kEvidenceWidth, kEvidenceHeight, {}};
    for (int y = 0; y < kEvidenceHeight; ++y)
      for (int x = 0; x < kEvidenceWidth; ++x)
        image.pixels.push_back(static_cast<uint8_t>(100 + 10 * std::sin(0.3 * (x - shift))));
    return image;
  };
  make_flow_field({}, stripes(0), stripes(2), {}, {0, 0, kEvidenceWidth, kEvidenceHeight}, 0.015,
                  out.flow);
  finish_flow_field(out.flow);
  return out;
}

// Pixels inside the pose's silhouette are evidence for the body, the others against it.
inline CameraEvidence evidence_of(const Camera& camera, const Body& body, const Pose& pose) {
  CameraEvidence seen;
  resize(seen.planes, {0, 0, kEvidenceWidth, kEvidenceHeight}, 1);
  std::vector<std::vector<float>> rows(kEvidenceHeight, std::vector<float>(kEvidenceWidth, -1.0F));
  const CapsuleList capsules =
      project_parts(camera, pose_parts(body, forward_kinematics(body, pose)));
  for (const VisibleRun& run : visible_runs(seen.planes.area, capsules))
    for (int x = run.x0; x < run.x1; ++x)
      rows[static_cast<size_t>(run.y)][static_cast<size_t>(x)] = 1;
  for (int y = 0; y < kEvidenceHeight; ++y)
    set_row(seen.planes, 0, y, rows[static_cast<size_t>(y)], 4);
  seen.pixel_weight = 0.2;
  return seen;
}

// The columns left of one show something opaque: evidence against a body.
inline void hide_left_of(int column, CameraEvidence& seen) {
  std::vector<float> row(kEvidenceWidth);
  for (int y = 0; y < kEvidenceHeight; ++y) {
    for (int x = 0; x < kEvidenceWidth; ++x)
      row[static_cast<size_t>(x)] =
          x < column ? -1.0F : static_cast<float>(log_ratio_at(seen.planes, Appearance{}, x, y));
    set_row(seen.planes, 0, y, row, 4);
  }
}

// A person in mid-stride at the origin.
inline Pose striding() {
  Pose pose;
  pose.root = {0, 0, 0.9};
  pose.legs[0] = {0.45, 0.03, 0, 0.2, 0.05};
  pose.legs[1] = {-0.25, 0.03, 0, 0.5, -0.1};
  return pose;
}

}  // namespace walktrack
