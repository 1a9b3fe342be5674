// A person in clothes of strong colours in front of a textured wall, and an observer of them.
#pragma once

#include <cmath>
#include <optional>

#include <opencv2/core.hpp>

#include "core/rng.h"
#include "observation/background/background_sampler.h"
#include "observation/observer.h"
#include "observation/silhouette/silhouette.h"
#include "tests/observation/scenes.h"

namespace walktrack {

// A textured wall, the same for one key whatever is drawn in front of it.
inline cv::Mat wall(int width, int height) {
  Rng rng(11, Purpose::kTest);
  cv::Mat image(height, width, CV_8UC3);
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x) {
      const double base = 110 + 30 * std::sin(0.11 * x) * std::cos(0.07 * y);
      for (int c = 0; c < 3; ++c)
        image.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<uint8_t>(base + 10 * c + 4 * rng.normal());
    }
  }
  return image;
}

inline cv::Vec3b clothes(Appearance appearance) {
  switch (appearance) {
    case Appearance::kTrunk:
      return {150, 60, 60};
    case Appearance::kLegs:
      return {40, 50, 130};
    case Appearance::kFeet:
      return {30, 30, 30};
    case Appearance::kHead:
      return {140, 170, 220};
    case Appearance::kArms:
      return {140, 170, 220};
  }
  return {};
}

inline void draw_body(cv::Mat& image, const CapsuleList& capsules) {
  for (const VisibleRun& run : visible_runs({0, 0, image.cols, image.rows}, capsules)) {
    const cv::Vec3b colour = clothes(capsules[static_cast<size_t>(run.capsule)].appearance);
    for (int x = run.x0; x < run.x1; ++x) {
      // Stripes give the flow term texture.
      const int stripe = (x + 2 * run.y) / 3 % 2 * 30;
      for (int c = 0; c < 3; ++c)
        image.at<cv::Vec3b>(run.y, x)[c] = cv::saturate_cast<uint8_t>(colour[c] + stripe);
    }
  }
}

struct World {
  Body body = make_body(Subject{}, {});
  Camera camera = camera_at({0, -5, 1.2}, {0, 0, 0.9}, 320, 320, 240);
  cv::Mat empty = wall(320, 240);

  Pose pose(double x) const {
    Pose out;
    out.root = {x, 0, 0.92};
    out.legs[0] = {0.4, 0, 0, 0.1, 0};
    out.legs[1] = {-0.2, 0, 0, 0.3, 0};
    return out;
  }
  CapsuleList capsules(const Pose& p) const { return project_parts(camera, posed(body, p)); }
  cv::Mat frame(const Pose& p) const {
    cv::Mat image = empty.clone();
    draw_body(image, capsules(p));
    return image;
  }
  Observer observer(const ObservationConfig& config, int threads = 1) const {
    BackgroundSampler sampler(config.background);
    sampler.add(empty);
    return Observer(config, {camera, 1, appearances_of(body), sampler.model(), {}, threads});
  }
};

}  // namespace walktrack
