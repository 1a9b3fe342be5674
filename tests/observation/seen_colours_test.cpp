#include "observation/background/seen_colours.h"

#include <algorithm>
#include <cmath>
#include <numeric>

#include <gtest/gtest.h>

#include "tests/observation/person_at_wall.h"

namespace walktrack {
namespace {

// The observation of somebody in front of the wall, whose left quarter is occluded, with the
// colours of its pixels.
struct Coloured {
  World world;
  ObservationConfig config;
  Observer observer = observed();
  Region region = [this] {
    Region out = whole_image(observer.camera(), 0.01);
    out.picture = true;
    return out;
  }();
  CameraEvidence seen = look();

  Observer observed() {
    config.background.drift_rate = 0;
    BackgroundSampler sampler(config.background);
    sampler.add(world.empty);
    const Polygon left{{-1, -1}, {80, -1}, {80, 240}, {-1, 240}};
    return Observer(config, {world.camera, 1, appearances_of(world.body), sampler.model(), {left}});
  }
  CameraEvidence look() {
    CameraEvidence out;
    observer.observe(world.frame(world.pose(0)), region, out);
    return out;
  }
  AppearanceModel unknown() const { return {config.foreground, appearances_of(world.body)}; }
  LogRatioPlanes compared(const AppearanceModel& model, const PixelRect& area) const {
    LogRatioPlanes out;
    compare_with(model, seen.colours, area, config.clip, out);
    return out;
  }
};

// By how much planes differ inside `area`, nats.
double difference(const LogRatioPlanes& a, const LogRatioPlanes& b, const PixelRect& area) {
  double most = 0;
  for (int k = 0; k < kAppearanceCount; ++k)
    for (int y = area.y0; y < area.y1; ++y)
      for (int x = area.x0; x < area.x1; ++x)
        most = std::max(most, std::abs(log_ratio_at(a, Appearance(k), x, y) -
                                       log_ratio_at(b, Appearance(k), x, y)));
  return most;
}

// Log densities of the background are kept to 1 / 256 nat, and log-ratios are as well.
constexpr double kRounded = 2.0 / 256;

TEST(SeenColours, ComparedWithUnknownClothesAreTheSameEvidence) {
  const Coloured scene;
  const PixelRect all = scene.seen.planes.area, part{70, 20, 250, 200};
  EXPECT_EQ(scene.seen.planes.count, 1);
  const LogRatioPlanes whole = scene.compared(scene.unknown(), all);
  EXPECT_EQ(whole.count, 1);
  EXPECT_LT(difference(whole, scene.seen.planes, all), kRounded);
  EXPECT_EQ(log_ratio_at(whole, Appearance::kTrunk, 75, 120), 0) << "occluded";
  EXPECT_NE(log_ratio_at(whole, Appearance::kTrunk, 85, 120), 0);
  const LogRatioPlanes inside = scene.compared(scene.unknown(), part);
  EXPECT_LT(difference(inside, scene.seen.planes, part), kRounded);
  EXPECT_EQ(log_ratio_at(inside, Appearance::kTrunk, 260, 120), 0) << "outside the part";
}

TEST(SeenColours, CountAsProbableAsThePixelsAreForeground) {
  const Coloured scene;
  const AppearanceModel clothes = scene.unknown();
  const CapsuleList parts = scene.world.capsules(scene.world.pose(-0.6));  // partly beside the body
  const SeenColours& seen = scene.seen.colours;
  const AppearanceModel::Counts counts = colours_inside(
      parts, scene.seen.planes, clothes, [&](int x, int y) { return seen.bin_at(x, y); });
  std::vector<double> pixels(counts.seen.size()), foreground(counts.seen.size());
  for (const VisibleRun& run : visible_runs(seen.area, parts)) {
    const Appearance appearance = parts[static_cast<size_t>(run.capsule)].appearance;
    const auto cls = static_cast<size_t>(clothes.class_of()[static_cast<size_t>(appearance)]);
    for (int x = std::max(run.x0, 81); x < run.x1; ++x) {  // not occluded
      pixels[cls] += 1;
      foreground[cls] +=
          0.5 + 0.5 * std::tanh(0.5 * log_ratio_at(scene.seen.planes, appearance, x, run.y));
    }
  }
  for (size_t cls = 0; cls < pixels.size(); ++cls) {
    const std::vector<float>& weights = counts.weights[cls];
    EXPECT_EQ(counts.seen[cls], pixels[cls]) << cls;
    EXPECT_NEAR(std::accumulate(weights.begin(), weights.end(), 0.0), foreground[cls],
                1e-3 * pixels[cls])
        << cls;
    EXPECT_LT(foreground[cls], 0.8 * pixels[cls]) << cls;
  }
}

// Colours that are learned from a frame that was kept are those that the observer learns from it.
TEST(SeenColours, TeachWhatTheObserverLearns) {
  Coloured scene;
  constexpr double kInner = 0.75;  // of the observer
  const CapsuleList parts = scene.world.capsules(scene.world.pose(0));
  const SeenColours& seen = scene.seen.colours;
  AppearanceModel clothes = scene.unknown();
  clothes.learn(ColourBins(),
                colours_inside(scaled_radii(parts, kInner), scene.seen.planes, clothes,
                               [&](int x, int y) { return seen.bin_at(x, y); }));
  scene.observer.learn(scene.seen, parts);
  const LogRatioPlanes next = scene.look().planes;
  EXPECT_EQ(next.count, clothes.classes());
  EXPECT_LT(difference(scene.compared(clothes, next.area), next, next.area), kRounded);
  EXPECT_GT(difference(scene.seen.planes, next, next.area), 1) << "the clothes have been learned";
}

TEST(SeenColours, AreOnlyKeptWithThePictureAndWhileTheClothesAreUnknown) {
  Coloured scene;
  EXPECT_FALSE(scene.seen.colours.empty());
  scene.region.picture = false;
  EXPECT_TRUE(scene.look().colours.empty());
  scene.region.picture = true;
  scene.observer.learn(scene.look(), scene.world.capsules(scene.world.pose(0)));
  EXPECT_TRUE(scene.look().colours.empty());
}

}  // namespace
}  // namespace walktrack
