// Cast shadows are not taken for legs: walks rendered with and without the walker's shadow show
// which pixels are in it, and the background model which of them look like a walker.
#include <array>
#include <string>
#include <vector>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/conventions.h"
#include "observation/background/background_sampler.h"
#include "observation/observer.h"
#include "synth/recording/sensor.h"
#include "synth/recording/stage.h"
#include "synth/walk/made_walk.h"

namespace walktrack {
namespace {

// Two seconds of a walk; one camera at its side, one in front that looks down on the floor.
Stage stage_in(Setting setting) {
  RenderOptions options;
  options.setting = setting;
  for (const double azimuth_deg : {-90.0, -25.0}) {
    RenderCamera camera;
    camera.name = "camera";
    camera.width_px = 320;
    camera.height_px = 240;
    camera.azimuth = rad_from_deg(azimuth_deg);
    camera.height = azimuth_deg < -45 ? 1.2 : 2;
    camera.distance = 4;
    camera.focal_px = 300;
    options.cameras.push_back(camera);
  }
  FilmedWalker walker;
  MadeWalk walk;
  walk.to = 2;
  walk.rate = 60;
  walk.start = {-1.25, 0};
  walker.motion = made_walk(make_body(Subject{}, {.head = true, .arms = true}), walk);
  return make_stage(walker, options, {});
}

// A class of pixels, with the number of those whose log-ratio for a walker exceeds a number of
// nats.
struct Share {
  int asked = 0, more_than_0 = 0, more_than_1 = 0;
  void add(double log_ratio) {
    ++asked;
    more_than_0 += log_ratio > 0;
    more_than_1 += log_ratio > 1;
  }
  double over_0() const { return more_than_0 / static_cast<double>(asked); }
  double over_1() const { return more_than_1 / static_cast<double>(asked); }
};

struct Shares {
  Share shadow, walker, rest;
};

cv::Mat image(const Plane<Colour>& light, uint32_t frame) {
  std::vector<uint8_t> bytes = developed(light, Sensor{}, 3, 0, frame);
  return cv::Mat(light.height, light.width, CV_8UC3, bytes.data()).clone();
}

Observer observer_of(const Stage& stage, const View& view, const BackgroundConfig& background) {
  ObservationConfig config;
  config.background = background;
  config.foreground.enabled = false;
  BackgroundSampler sampler(background);
  for (uint32_t i = 0; i < 10; ++i) sampler.add(image(view.empty, i));
  return Observer(config,
                  {view.camera, 1, appearances_of(stage.actors[0].body), sampler.model(), {}});
}

void add_pixels(const Picture& seen, const Picture& unshaded, const LogRatioPlanes& planes,
                Shares& shares) {
  constexpr float kInShadow = 0.85F;  // share of the light that remains
  for (int y = 0; y < seen.colour.height; ++y) {
    for (int x = 0; x < seen.colour.width; ++x) {
      const double log_ratio = log_ratio_at(planes, Appearance::kLegs, x, y);
      const float left = seen.colour.at(x, y).sum() / unshaded.colour.at(x, y).sum();
      if (seen.sights.at(x, y).walker >= 0) {
        shares.walker.add(log_ratio);
      } else if (left < kInShadow) {
        shares.shadow.add(log_ratio);
      } else if (left == 1) {
        shares.rest.add(log_ratio);
      }
    }
  }
}

// One for each configuration of the background, over both cameras and four frames.
std::vector<Shares> shares_in(Setting setting, const std::vector<BackgroundConfig>& configs) {
  const Stage stage = stage_in(setting);
  World unshaded = stage.world;
  unshaded.light.shadows = false;
  std::vector<Shares> shares(configs.size());
  for (const Camera& camera : stage.cameras) {
    const View view = make_view(stage.world, camera, 2);
    std::vector<Observer> observers;
    for (const BackgroundConfig& config : configs)
      observers.push_back(observer_of(stage, view, config));
    for (uint32_t frame = 1; frame <= 4; ++frame) {
      const auto actors = actors_at(stage, 0.4 * frame);
      const Picture seen = render(view, stage.world, actors);
      const Picture without_shadow = render(view, unshaded, actors);
      for (size_t i = 0; i < observers.size(); ++i) {
        CameraEvidence evidence;
        observers[i].observe(image(seen.colour, 100 + frame), whole_image(camera, 0.013), evidence);
        add_pixels(seen, without_shadow, evidence.planes, shares[i]);
      }
    }
  }
  return shares;
}

class CastShadow : public testing::TestWithParam<Setting> {};

std::string setting_name(const testing::TestParamInfo<Setting>& info) {
  const std::array<std::string, 3> names{"room", "field", "studio"};
  return names[static_cast<size_t>(info.param)];
}

// The results are in lib/observation/reports/background.md.
TEST_P(CastShadow, IsNotTakenForAWalker) {
  BackgroundConfig unaware;
  unaware.shadow_share = 0;
  const std::vector<Shares> shares = shares_in(GetParam(), {unaware, {}});
  const Shares &before = shares[0], &now = shares[1];
  ASSERT_GT(now.shadow.asked, 2000);
  EXPECT_GT(before.shadow.over_1(), 0.95);
  EXPECT_LT(now.shadow.over_1(), 0.05);
  EXPECT_LT(now.shadow.over_0(), GetParam() == Setting::kStudio ? 0.45 : 0.05);
  EXPECT_GT(now.walker.over_0(), before.walker.over_0() - 0.05);
  EXPECT_LT(now.rest.over_0(), 0.005);
}

INSTANTIATE_TEST_SUITE_P(Settings, CastShadow,
                         testing::Values(Setting::kRoom, Setting::kField, Setting::kStudio),
                         setting_name);

}  // namespace
}  // namespace walktrack
