#include "observation/observer.h"

#include <algorithm>
#include <functional>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "core/errors.h"
#include "core/parallel_for.h"
#include "observation/background/background_sampler.h"
#include "observation/shrink.h"
#include "tests/observation/person_at_wall.h"
#include "tests/observation/picture_terms.h"
#include "tests/observation/rendered.h"
#include "tests/observation/scenes.h"

namespace walktrack {
namespace {

// In an eighth of the light the true place is as much more probable than one beside it.
TEST(Observer, SeesInTheDark) {
  const World world;
  const ObservationConfig config;
  const auto contrast = [&](double light) {
    BackgroundSampler sampler(config.background);
    sampler.add(world.empty * light);
    Observer observer(config, {world.camera, 1, appearances_of(world.body), sampler.model(), {}});
    CameraEvidence evidence;
    observer.observe(world.frame(world.pose(0)) * light, whole_image(observer.camera(), 0.01),
                     evidence);
    const auto ratio = [&](double x) {
      return silhouette_log_ratio(evidence.planes, world.capsules(world.pose(x)));
    };
    return ratio(0) - ratio(0.1);
  };
  EXPECT_GT(contrast(0.125), 0.7 * contrast(1));
}

// Without colours the true place is still more probable than one beside it.
TEST(Observer, SeesWithoutColours) {
  const World world;
  const ObservationConfig config;
  BackgroundSampler sampler(config.background);
  sampler.add(without_colours(world.empty));
  Observer observer(config, {world.camera, 1, appearances_of(world.body), sampler.model(), {}});
  EXPECT_TRUE(observer.change().colourless);
  CameraEvidence evidence;
  // Its colours do not count.
  observer.observe(world.frame(world.pose(0)), whole_image(observer.camera(), 0.01), evidence);
  const auto ratio = [&](double x) {
    return silhouette_log_ratio(evidence.planes, world.capsules(world.pose(x)));
  };
  EXPECT_GT(ratio(0), 0);
  EXPECT_GT(ratio(0), ratio(0.1));
  CameraEvidence grey;
  Observer same(config, {world.camera, 1, appearances_of(world.body), sampler.model(), {}});
  same.observe(without_colours(world.frame(world.pose(0))), whole_image(same.camera(), 0.01), grey);
  EXPECT_EQ(evidence.planes.prefix, grey.planes.prefix);
}

TEST(Observer, TermsThatAreOffHoldNoMemory) {
  const World world;
  ObservationConfig config;
  config.foreground.enabled = config.background.enabled = false;
  Observer observer(config, {world.camera, 1, appearances_of(world.body), std::nullopt, {}});
  CameraEvidence evidence;
  for (int i = 0; i < 2; ++i)
    observer.observe(world.frame(world.pose(0)), whole_image(observer.camera(), 0.01), evidence);
  EXPECT_EQ(evidence.planes.prefix.capacity(), 0U);
  EXPECT_EQ(evidence.flow.cells.capacity(), 0U);
  EXPECT_EQ(evidence.flow.before.capacity(), 0U);
  const CapsuleList capsules = world.capsules(world.pose(0));
  EXPECT_EQ(log_likelihood(config, evidence, capsules, &capsules), 0);
}

TEST(Observer, OnePlaneUntilTheWalkerIsLearned) {
  const World world;
  const ObservationConfig config;
  Observer observer = world.observer(config);
  CameraEvidence evidence;
  observer.observe(world.frame(world.pose(0)), whole_image(observer.camera(), 0.01), evidence);
  EXPECT_EQ(evidence.planes.count, 1);
  const CapsuleList capsules = world.capsules(world.pose(0));
  const double generic = silhouette_log_ratio(evidence.planes, capsules);
  observer.learn(evidence, capsules);
  observer.observe(world.frame(world.pose(0)), whole_image(observer.camera(), 0.01), evidence);
  EXPECT_EQ(evidence.planes.count, 4);  // trunk, legs, feet, head
  EXPECT_GT(silhouette_log_ratio(evidence.planes, capsules), generic);
}

TEST(Observer, MergedClassesShareAPlane) {
  const World world;
  ObservationConfig config;
  config.foreground.classes = {0, 1, 1, 0, 0};
  Observer observer = world.observer(config);
  CameraEvidence evidence;
  observer.observe(world.frame(world.pose(0)), whole_image(observer.camera(), 0.01), evidence);
  observer.learn(evidence, world.capsules(world.pose(0)));
  observer.observe(world.frame(world.pose(0)), whole_image(observer.camera(), 0.01), evidence);
  EXPECT_EQ(evidence.planes.count, 2);
  const auto& plane_of = evidence.planes.plane_of;
  EXPECT_EQ(plane_of[static_cast<size_t>(Appearance::kLegs)],
            plane_of[static_cast<size_t>(Appearance::kFeet)]);
}

TEST(Observer, RegionLimitsWhatIsComputed) {
  const World world;
  const ObservationConfig config = every_term();
  Observer whole = world.observer(config), part = world.observer(config);
  const Region region = person_region(part.camera(), {0, 0}, 1.75, 0.7);
  EXPECT_LT(region.area.width() * region.area.height(), 320 * 240 / 2);
  CameraEvidence a, b;
  for (const double x : {0.0, 0.02}) {
    whole.observe(world.frame(world.pose(x)), whole_image(whole.camera(), region.metres_per_px), a);
    part.observe(world.frame(world.pose(x)), region, b);
  }
  EXPECT_LT(b.planes.prefix.size(), a.planes.prefix.size() / 2);
  const CapsuleList now = world.capsules(world.pose(0.02));
  EXPECT_EQ(silhouette_log_ratio(a.planes, now), silhouette_log_ratio(b.planes, now));
  EXPECT_EQ(a.pixel_weight, b.pixel_weight);
  const Region nowhere = person_region(part.camera(), {0, -9}, 1.75, 0.4);
  EXPECT_TRUE(nowhere.area.empty());
  part.observe(world.frame(world.pose(0)), nowhere, b);
  EXPECT_EQ(log_likelihood(config, b, now, &now), 0);
}

// The next frame may be prepared, and prepared again for another region, before this one has been
// learned from.
TEST(Observer, PreparingTheNextFrameEarlyChangesNothing) {
  const World world;
  Observer plain = world.observer(every_term()), early = world.observer(every_term());
  Region region = person_region(plain.camera(), {0, 0}, 1.75, 0.7);
  region.picture = true;
  const cv::Mat frames[] = {world.frame(world.pose(0)), world.frame(world.pose(0.02)),
                            world.frame(world.pose(0.04))};
  CameraEvidence a, b;
  PreparedFrame next;
  early.prepare(frames[0], region, 1, next);
  for (int f = 0; f < 3; ++f) {
    plain.observe(frames[f], region, a);
    early.complete(next, b);
    ASSERT_EQ(a.planes.prefix, b.planes.prefix) << f;
    ASSERT_EQ(a.planes.count, b.planes.count);
    ASSERT_EQ(a.flow.cells.size(), b.flow.cells.size());
    for (size_t i = 0; i < a.flow.cells.size(); ++i) {
      ASSERT_EQ(a.flow.cells[i].now, b.flow.cells[i].now);
      ASSERT_EQ(a.flow.cells[i].uncovered, b.flow.cells[i].uncovered);
    }
    ASSERT_EQ(a.picture.pixels, b.picture.pixels);
    if (f < 2) {
      early.prepare(frames[f + 1], person_region(plain.camera(), {1, 0}, 1.75, 0.3), 1, next);
      early.prepare(frames[f + 1], region, 2, next);
    }
    const CapsuleList capsules = world.capsules(world.pose(0.02 * f));
    plain.learn(a, capsules);
    early.learn(b, capsules);
  }
  EXPECT_EQ(plain.state().background->luma, early.state().background->luma);
}

TEST(Observer, ThreadsDoNotMatter) {
  const World world;
  Observer one = world.observer(every_term()), four = world.observer(every_term(), 4);
  CameraEvidence a, b;
  for (const double x : {0.0, 0.02}) {
    const cv::Mat frame = world.frame(world.pose(x));
    one.observe(frame, whole_image(one.camera(), 0.01), a);
    four.observe(frame, whole_image(four.camera(), 0.01), b);
    EXPECT_EQ(a.planes.prefix, b.planes.prefix);
    one.learn(a, world.capsules(world.pose(x)));
    four.learn(b, world.capsules(world.pose(x)));
  }
}

TEST(Observer, HoldsThePictureWhereItIsWanted) {
  const World world;
  Observer observer = world.observer({});
  CameraEvidence evidence;
  Region region = whole_image(observer.camera(), 0.01);
  region.picture = true;
  observer.observe(world.empty, region, evidence);
  ASSERT_EQ(evidence.picture.pixels.size(), size_t{320 * 240});
  EXPECT_EQ(evidence.picture.width, 320);
  region.picture = false;
  observer.observe(world.empty, region, evidence);
  EXPECT_TRUE(evidence.picture.pixels.empty());
}

TEST(Observer, PersonRegionHoldsTheBody) {
  const World world;
  Rng rng(1, Purpose::kTest);
  for (int i = 0; i < 100; ++i) {
    const Pose pose = random_walking_pose(rng);
    const Region region = person_region(world.camera, pose.root.head<2>(), 1.75, 0.8);
    for (const Capsule& capsule : world.capsules(pose)) {
      for (const Disc& disc : {capsule.lower, capsule.upper}) {
        if (!inside_image(world.camera, disc.centre)) continue;
        EXPECT_GE(disc.centre.x(), region.area.x0);
        EXPECT_LE(disc.centre.x(), region.area.x1);
        EXPECT_GE(disc.centre.y(), region.area.y0);
        EXPECT_LE(disc.centre.y(), region.area.y1);
      }
    }
  }
}

TEST(Observer, OccludersSayNothing) {
  const World world;
  const ObservationConfig config = every_term();
  BackgroundSampler sampler(config.background);
  sampler.add(world.empty);
  const Polygon left_half{{-1, -1}, {160, -1}, {160, 240}, {-1, 240}};
  Observer observer(config,
                    {world.camera, 1, appearances_of(world.body), sampler.model(), {left_half}});
  CameraEvidence evidence;
  for (const double x : {-0.05, 0.0})
    observer.observe(world.frame(world.pose(x)), whole_image(observer.camera(), 0.01), evidence);
  for (int y = 0; y < 240; ++y)
    EXPECT_EQ(log_ratio_at(evidence.planes, Appearance::kTrunk, 150, y), 0);
  EXPECT_NE(log_ratio_at(evidence.planes, Appearance::kTrunk, 165, 120), 0);
  const auto seen = [&](int x) {
    const FlowField& flow = evidence.flow;
    return flow.cells[static_cast<size_t>(120 / flow.step * flow.columns + x / flow.step)].now;
  };
  EXPECT_LT(seen(150), 0);
  EXPECT_GE(seen(170), 0);
}

// The background behind people who always stood there is unknown, whatever else moves.
TEST(Observer, PixelsThatWereNeverSeenGiveNoEvidence) {
  const World world;
  BackgroundSampler sampler({});
  sampler.add(world.empty);
  BackgroundModel model = sampler.model();
  for (size_t y = 0; y < 240; ++y)
    std::fill_n(model.luma_precision.begin() + static_cast<long>(320 * y), 160, kNeverSeen);
  Observer observer({}, {world.camera, 1, appearances_of(world.body), model, {}});
  const auto ratio = [&](int x) {
    CameraEvidence evidence;
    observer.observe(world.frame(world.pose(0)), whole_image(observer.camera(), 0.01), evidence);
    return log_ratio_at(evidence.planes, Appearance::kTrunk, x, 120);
  };
  EXPECT_EQ(ratio(155), 0);
  EXPECT_NE(ratio(165), 0);
  observer.hide({{{160, -1}, {320, -1}, {320, 240}, {160, 240}}});
  EXPECT_EQ(ratio(165), 0);
  observer.hide({});
  EXPECT_EQ(ratio(155), 0);
  EXPECT_NE(ratio(165), 0);
}

// A prepared frame keeps its memory, but no flow from before dropped frames.
TEST(Observer, AfterDroppedFramesThereIsNoFlowForAnOccluderToBlock) {
  const World world;
  Observer observer = world.observer(every_term());
  observer.hide({{{-1, -1}, {160, -1}, {160, 240}, {-1, 240}}});
  CameraEvidence evidence;
  PreparedFrame frame;
  for (int i = 0; i < 4; ++i) {
    if (i == 3) observer.forget_previous_frame();
    observer.prepare(world.frame(world.pose(0.02 * i)), whole_image(observer.camera(), 0.01), 1,
                     frame);
    observer.complete(frame, evidence);
    EXPECT_EQ(evidence.flow.area.empty(), i == 0 || i == 3) << i;
    EXPECT_EQ(evidence.flow.cells.empty(), i == 0 || i == 3) << i;
  }
}

TEST(Observer, OccludersMayComeAndGo) {
  const World world;
  Observer observer = world.observer({});
  const auto ratio = [&] {
    CameraEvidence evidence;
    observer.observe(world.frame(world.pose(0)), whole_image(observer.camera(), 0.01), evidence);
    return log_ratio_at(evidence.planes, Appearance::kTrunk, 165, 120);
  };
  const auto seen = ratio();
  EXPECT_NE(seen, 0);
  observer.hide({{{-1, -1}, {320, -1}, {320, 240}, {-1, 240}}});
  EXPECT_EQ(ratio(), 0);
  observer.hide({});
  // Light and drift are followed meanwhile: the same image has the same evidence to some per cent.
  EXPECT_NEAR(ratio(), seen, 0.1 * std::abs(seen));
}

TEST(Observer, RefusesFramesAndModelsOfAnotherSize) {
  const World world;
  const ObservationConfig config;
  Observer observer = world.observer(config);
  CameraEvidence evidence;
  EXPECT_THROW(observer.observe(cv::Mat::zeros(10, 10, CV_8UC3), {}, evidence), InputError);
  BackgroundSampler sampler(config.background);
  sampler.add(cv::Mat::zeros(48, 64, CV_8UC3));
  const auto make = [&](std::optional<BackgroundModel> model) {
    return Observer(config, {world.camera, 1, appearances_of(world.body), std::move(model), {}});
  };
  EXPECT_THROW(make(sampler.model()), InputError);
  EXPECT_THROW(make(std::nullopt), InputError);
}

// For each term alone the pose that made the frames is more likely than shifted poses.
class TermAlone : public testing::TestWithParam<int> {};

TEST_P(TermAlone, TruePoseBeatsPerturbedPoses) {
  const World world;
  ObservationConfig config;
  config.foreground.enabled = GetParam() == 0;
  config.background.enabled = GetParam() == 1;
  config.flow.enabled = GetParam() == 2 ? TermSetting::kOn : TermSetting::kOff;
  Observer observer = world.observer(config);
  CameraEvidence evidence;
  const double step = 0.04;  // m per frame
  Pose pose;
  for (int i = 0; i < 4; ++i) {
    pose = world.pose(i * step);
    observer.observe(world.frame(pose), whole_image(observer.camera(), 0.016), evidence);
    observer.learn(evidence, world.capsules(pose));
  }
  const CapsuleList before = world.capsules(world.pose(2 * step));
  const auto score = [&](const Pose& p) {
    const CapsuleList capsules = world.capsules(p);
    return log_likelihood(config, evidence, capsules, &before);
  };
  const double best = score(pose);
  EXPECT_GT(best, 0);
  const std::vector<std::pair<const char*, std::function<void(Pose&)>>> changes{
      {"10 cm ahead", [](Pose& p) { p.root.x() += 0.1; }},
      {"10 cm behind", [](Pose& p) { p.root.x() -= 0.1; }},
      {"10 cm up", [](Pose& p) { p.root.z() += 0.1; }},
      {"leaning", [](Pose& p) { p.tilt += 0.3; }},
      {"thigh ahead", [](Pose& p) { p.legs[0].hip_flexion += 0.3; }},
      {"knee bent", [](Pose& p) { p.legs[1].knee_flexion += 0.5; }},
  };
  for (const auto& [name, change] : changes) {
    Pose other = pose;
    change(other);
    EXPECT_LT(score(other), best) << name;
  }
}

// An image of half the size has a quarter of the pixels, each of which represents four times the
// area.
TEST(Observer, LevelsOfThePyramidWeighTheSameArea) {
  const World world;
  ObservationConfig config;
  config.foreground.enabled = false;
  const auto gain = [&](int factor) {  // of the true pose over one 10 cm in front
    BackgroundSampler sampler(config.background);
    sampler.add(shrunk(world.empty, factor));
    Observer observer(config,
                      {world.camera, factor, appearances_of(world.body), sampler.model(), {}});
    CameraEvidence evidence;
    const double metres_per_px = 5.0 * factor / 320;
    observer.observe(shrunk(world.frame(world.pose(0)), factor),
                     whole_image(observer.camera(), metres_per_px), evidence);
    const auto score = [&](double x) {
      return log_likelihood(config, evidence,
                            project_parts(observer.camera(), posed(world.body, world.pose(x))),
                            nullptr);
    };
    return score(0) - score(0.1);
  };
  const double full = gain(1), half = gain(2);
  EXPECT_GT(full, 0);
  // At half the size edges are blurred over a twelfth of the body's width: a tenth of the sum
  // either way.
  EXPECT_NEAR(half / full, 1, 0.15);
}

std::string term_name(const testing::TestParamInfo<int>& info) {
  const std::array<std::string, 3> names{"foreground", "background", "flow"};
  return names[static_cast<size_t>(info.param)];
}

INSTANTIATE_TEST_SUITE_P(Terms, TermAlone, testing::Values(0, 1, 2), term_name);

TEST(Observer, SameBitsForAnyNumberOfThreads) {
  const World world;
  const ObservationConfig config = every_term();
  const auto run = [&](int threads) {
    cv::setNumThreads(threads);
    Observer observer = world.observer(config);
    CameraEvidence evidence;
    for (const double x : {0.0, 0.03, 0.06}) {
      observer.observe(world.frame(world.pose(x)), whole_image(observer.camera(), 0.016), evidence);
      observer.learn(evidence, world.capsules(world.pose(x)));
    }
    std::vector<double> scores(64);
    parallel_for(scores.size(), threads, [&](size_t i) {
      const double x = 0.06 + 0.002 * static_cast<double>(i);
      const CapsuleList now = world.capsules(world.pose(x)),
                        before = world.capsules(world.pose(0.03));
      scores[i] = log_likelihood(config, evidence, now, &before);
    });
    return scores;
  };
  const int usual = cv::getNumThreads();
  const std::vector<double> one = run(1);
  EXPECT_EQ(one, run(2));
  EXPECT_EQ(one, run(8));
  cv::setNumThreads(usual);
}

}  // namespace
}  // namespace walktrack
