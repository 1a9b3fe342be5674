// The effect of each option of a recording on the images.
#include "synth/recording/stage.h"

#include <algorithm>
#include <cmath>
#include <set>

#include <gtest/gtest.h>

#include "core/conventions.h"
#include "synth/walk/made_walk.h"

namespace walktrack {
namespace {

using Image = Plane<Colour>;

FilmedWalker walker() {
  FilmedWalker out;
  MadeWalk walk;
  walk.to = 2;
  walk.rate = 60;
  out.motion = made_walk(make_body(Subject{}, {.head = true, .arms = true}), walk);
  return out;
}

// Two seconds in a studio, one small camera at the right side.
RenderOptions options() {
  RenderOptions out;
  out.setting = Setting::kStudio;
  RenderCamera camera;
  camera.name = "side";
  camera.width_px = 160;
  camera.height_px = 120;
  camera.distance = 4;
  out.cameras = {camera};
  return out;
}

struct Shot {
  Image image, empty;
  Plane<uint8_t> labels;
};

constexpr double kTime = 1;  // s, of the shots: the middle of the walk

Shot shot(const FilmedWalker& who, const RenderOptions& how, double time = kTime) {
  const Stage stage = make_stage(who, how, {});
  const View view = make_view(stage.world, stage.cameras[0], 2);
  const auto actors = actors_at(stage, time);
  return {exposed(stage, view, how.shutter, time, how.frame_rate), view.empty,
          labels_of(render(view, stage.world, actors).sights)};
}

double brightness(const Image& image) {
  double sum = 0;
  for (const Colour& colour : image.values) sum += static_cast<double>(colour.sum());
  return sum / static_cast<double>(image.values.size());
}

// Pixels for which `wanted(index)` holds and whose colours differ.
template <typename F>
int different(const Image& a, const Image& b, F wanted) {
  int count = 0;
  for (size_t i = 0; i < a.values.size(); ++i)
    count += wanted(i) && (a.values[i] - b.values[i]).cwiseAbs().maxCoeff() > 0.02f;
  return count;
}

int walker_pixels(const Plane<uint8_t>& labels) {
  return static_cast<int>(std::count_if(labels.values.begin(), labels.values.end(),
                                        [](uint8_t label) { return label != 0; }));
}

// Neither the walker nor one of the pixels at its edge, which show a part of it.
bool away_from_walker(const Plane<uint8_t>& labels, size_t i) {
  const int x = static_cast<int>(i) % labels.width, y = static_cast<int>(i) / labels.width;
  for (int v = std::max(0, y - 1); v <= std::min(labels.height - 1, y + 1); ++v)
    for (int u = std::max(0, x - 1); u <= std::min(labels.width - 1, x + 1); ++u)
      if (labels.at(u, v) != 0) return false;
  return true;
}

const auto kEverywhere = [](size_t) { return true; };

TEST(Stage, ClothesColourTheWalkerAndNothingElse) {
  FilmedWalker other = walker();
  other.clothes = 1;
  const Shot a = shot(walker(), options()), b = shot(other, options());
  EXPECT_EQ(a.labels.values, b.labels.values);
  const auto is_walker = [&](size_t i) { return a.labels.values[i] != 0; };
  EXPECT_GT(different(a.image, b.image, is_walker), walker_pixels(a.labels) / 3);
  EXPECT_EQ(different(a.empty, b.empty, kEverywhere), 0);
}

TEST(Stage, ArmsAreThereOrNot) {
  FilmedWalker without = walker();
  without.arms = false;
  const Shot a = shot(walker(), options()), b = shot(without, options());
  EXPECT_GT(walker_pixels(a.labels), walker_pixels(b.labels));
  const std::set<uint8_t> with(a.labels.values.begin(), a.labels.values.end()),
      less(b.labels.values.begin(), b.labels.values.end());
  EXPECT_GT(with.size(), less.size());
}

TEST(Stage, SettingsDifferInTheirTextures) {
  std::vector<Image> empties;
  for (const Setting setting : {Setting::kRoom, Setting::kField, Setting::kStudio}) {
    RenderOptions how = options();
    how.setting = setting;
    empties.push_back(shot(walker(), how).empty);
    // Textured ground: neighbours along the lowest row differ.
    const Image& empty = empties.back();
    int steps = 0;
    for (int x = 1; x < empty.width; ++x)
      steps += (empty.at(x, 115) - empty.at(x - 1, 115)).cwiseAbs().maxCoeff() > 0.005f;
    EXPECT_GT(steps, 5) << static_cast<int>(setting);
  }
  const int pixels = 160 * 120;
  EXPECT_GT(different(empties[0], empties[1], kEverywhere), pixels / 2);
  EXPECT_GT(different(empties[0], empties[2], kEverywhere), pixels / 2);
  EXPECT_GT(different(empties[1], empties[2], kEverywhere), pixels / 4);
}

TEST(Stage, LightIsSumOfSunAndAmbient) {
  RenderOptions dim = options(), flat = options();
  dim.light.sun *= 0.5;
  dim.light.ambient *= 0.5;
  flat.light.sun = 0;
  const double bright = brightness(shot(walker(), options()).image);
  EXPECT_LT(brightness(shot(walker(), dim).image), 0.95 * bright);
  EXPECT_LT(brightness(shot(walker(), flat).image), 0.95 * bright);
  // The direction of the sun decides which side of the walker is lit.
  RenderOptions moved = options();
  moved.light.azimuth += kPi;
  const Shot a = shot(walker(), options()), b = shot(walker(), moved);
  EXPECT_GT(different(a.image, b.image, [&](size_t i) { return a.labels.values[i] != 0; }),
            walker_pixels(a.labels) / 2);
}

TEST(Stage, ShadowsDarkenTheGroundOppositeTheSun) {
  RenderOptions low = options(), without = options();
  low.light.elevation = without.light.elevation = 0.5;
  without.light.shadows = false;
  const Shot with = shot(walker(), low), none = shot(walker(), without);
  const auto is_ground = [&](size_t i) { return away_from_walker(with.labels, i); };
  EXPECT_EQ(different(none.image, none.empty, is_ground), 0);
  int darker = 0;
  for (size_t i = 0; i < with.image.values.size(); ++i)
    darker += is_ground(i) && with.image.values[i].sum() < 0.8f * none.image.values[i].sum();
  EXPECT_GT(darker, 30);
  low.light.azimuth += kPi;
  EXPECT_GT(different(with.image, shot(walker(), low).image, is_ground), 30);
}

TEST(Stage, MotionBlurIsTheMeanOfTheShuttersInstants) {
  RenderOptions blurred = options();
  blurred.frame_rate = 15;
  blurred.shutter = {.open = 0.8, .blur_samples = 4};
  const Shot blur = shot(walker(), blurred), sharp = shot(walker(), options());
  // Open for 0.8 / 15 s around the frame's time: four samples in the middles of its quarters.
  Image mean(160, 120, Colour::Zero());
  for (const double quarter : {-1.5, -0.5, 0.5, 1.5}) {
    const Shot instant = shot(walker(), options(), kTime + quarter / 4 * 0.8 / 15);
    for (size_t i = 0; i < mean.values.size(); ++i)
      mean.values[i] += 0.25f * instant.image.values[i];
  }
  for (size_t i = 0; i < mean.values.size(); ++i)
    ASSERT_LT((mean.values[i] - blur.image.values[i]).norm(), 1e-5f);
  EXPECT_GT(different(blur.image, sharp.image, kEverywhere), 100);
  EXPECT_LT(different(blur.image, sharp.image, kEverywhere), 160 * 120 / 4);
}

TEST(Stage, OccludersHideTheWalkerAndStandInTheEmptySceneToo) {
  const Shot open = shot(walker(), options());
  RenderOptions how = options();
  // The camera is 4 m to the right of the walk (negative y), the walker near x = 1.25.
  how.occluders.push_back({upright_cone({1.25, -1, 0}, 1.0, 0.3, 0.3), {}, true});
  const Shot hidden = shot(walker(), how);
  EXPECT_LT(walker_pixels(hidden.labels), 0.7 * walker_pixels(open.labels));
  EXPECT_GT(walker_pixels(hidden.labels), 0);  // the post is one metre high
  EXPECT_GT(different(hidden.empty, open.empty, kEverywhere), 300);
}

TEST(Stage, FurtherWalkersAreLabelledAfterTheFirstWhoseTruthItIs) {
  RenderOptions how = options();
  FilmedWalker second = walker();
  second.shift = {0.3, -0.8};
  second.clothes = 3;
  how.others.push_back(second);
  const Shot both = shot(walker(), how), alone = shot(walker(), options());
  const auto count = [&](auto wanted) {
    return std::count_if(both.labels.values.begin(), both.labels.values.end(), wanted);
  };
  EXPECT_GT(count([](uint8_t label) { return label > 100; }), 200);
  EXPECT_LT(count([](uint8_t label) { return label > 0 && label <= 100; }),
            walker_pixels(alone.labels));  // the second one is in front
  const Stage stage = make_stage(walker(), how, {});
  const double time = kTime;
  EXPECT_EQ(
      truth_at(stage, std::span(&time, 1)).joints[0][Joint::kPelvis],
      truth_at(make_stage(walker(), options(), {}), std::span(&time, 1)).joints[0][Joint::kPelvis]);
}

// Straight edges are bent: an object's image moves as the lens distorts.
TEST(Stage, LensesAreTheirCameras) {
  RenderOptions how = options();
  how.cameras[0].distortion = {-0.3, 0.1, 0, 0};
  const Shot straight = shot(walker(), options()), bent = shot(walker(), how);
  EXPECT_GT(different(straight.empty, bent.empty, kEverywhere), 160 * 120 / 10);
  how = options();
  how.cameras[0].focal_px = 2 * 1.05 * 160;
  EXPECT_GT(walker_pixels(shot(walker(), how).labels), 2 * walker_pixels(straight.labels));
}

}  // namespace
}  // namespace walktrack
