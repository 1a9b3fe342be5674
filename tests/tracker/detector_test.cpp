#include "tracker/detect/detector.h"

#include <cmath>
#include <optional>
#include <utility>

#include <gtest/gtest.h>

#include "core/conventions.h"
#include "tests/tracker/frame_time.h"
#include "tests/tracker/side_camera.h"

namespace walktrack {
namespace {

// A bell-shaped score around a person's place.
double bell(const Eigen::Vector2d& place, const Eigen::Vector2d& truth, double height) {
  return height * std::exp(-(place - truth).squaredNorm() / (2 * 0.3 * 0.3));
}

constexpr size_t kWindowFrames = 24;
const Eigen::Vector2d kEye(0, -6);

struct Window {
  std::vector<Place> early, late;
  WindowScore score;

  std::optional<DetectedWalk> walk(int threads = 1, LineCondition may_be = {}) const {
    return detect_walk({kWindowFrames, early, late, {}, std::move(may_be)}, score, kDt,
                       std::vector{kEye}, {}, threads);
  }
};

Window window(const std::function<double(size_t, const Eigen::Vector2d&)>& score) {
  const std::vector<Camera> cameras{side_camera(1)};
  const PlaceGrid grid = place_grid(cameras, 1.75, {});
  const auto figures = [&](size_t f) {
    return find_figures([&](const Eigen::Vector2d& p) { return score(f, p); }, grid, {}, 1);
  };
  const WindowEnds ends = window_ends(kWindowFrames);
  return {figures(ends.early), figures(ends.late),
          [=](size_t f, const Eigen::Vector2d& p, const Eigen::Vector2d&, std::optional<size_t>) {
            return FigureInFrame{score(f, p)};
          }};
}

// The same score, which counts how often it is asked.
template <typename Count>
WindowScore counted(const WindowScore& score, Count& asked) {
  return [&asked, score](size_t frame, const Eigen::Vector2d& place,
                         const Eigen::Vector2d& velocity, std::optional<size_t> index) {
    ++asked;
    return score(frame, place, velocity, index);
  };
}

Eigen::Vector2d walker_at(size_t frame) { return {-0.8 + 1.3 * kDt * double(frame), 0.4}; }

TEST(StandingPlaces, FiguresStandWhollyInTheImage) {
  const std::vector<Camera> cameras{side_camera(1)};
  const auto places = standing_places(cameras, 1.75, {});
  ASSERT_GT(places.size(), 100u);
  for (const Eigen::Vector2d& p : places) {
    const auto foot = project(cameras[0], Eigen::Vector3d(p.x(), p.y(), 0));
    const auto head = project(cameras[0], Eigen::Vector3d(p.x(), p.y(), 1.75));
    ASSERT_TRUE(foot && head);
    EXPECT_TRUE(inside_image(cameras[0], *foot) && inside_image(cameras[0], *head));
  }
}

// A figure of 200 px in a picture of 640: every second row and column suffices to see where it is.
TEST(PlaceGrid, FindsTheSameFiguresWithFewerTrials) {
  const std::vector<Camera> cameras{side_camera(1)};
  const PlaceGrid grid = place_grid(cameras, 1.75, {});
  PlaceGrid all = grid;
  for (std::vector<uint32_t>& guides : all.guides) guides.clear();
  size_t tried = 0;
  const auto score = [&](const Eigen::Vector2d& p) {
    ++tried;
    return bell(p, walker_at(0), 100) + bell(p, {0.8, 1.8}, 120) - 30;
  };
  const std::vector<Place> found = find_figures(score, grid, {}, 1);
  const size_t with_guides = std::exchange(tried, 0);
  const std::vector<Place> wanted = find_figures(score, all, {}, 1);
  EXPECT_EQ(tried, grid.places.size());
  EXPECT_LT(with_guides, 2 * tried / 3);
  ASSERT_EQ(found.size(), wanted.size());
  ASSERT_GE(found.size(), 2u);
  for (size_t i = 0; i < found.size(); ++i) EXPECT_EQ(found[i].position, wanted[i].position);
}

TEST(PlaceGrid, TriesEveryPlaceOfSmallFigures) {
  const std::vector<Camera> cameras{side_camera(1)};
  for (const std::vector<uint32_t>& guides : place_grid(cameras, 0.4, {}).guides)
    EXPECT_TRUE(guides.empty());
}

TEST(DetectWalk, FindsAWalkerBetweenThingsThatStandStill) {
  const Window f = window([](size_t frame, const Eigen::Vector2d& p) {
    return bell(p, walker_at(frame), 100) + bell(p, {0.8, 1.8}, 120);
  });
  const auto walk = f.walk();
  ASSERT_TRUE(walk);
  EXPECT_LT((walk->position - walker_at(0)).norm(), 0.03);  // the search ends at 1 cm steps
  EXPECT_NEAR(walk->velocity.x(), 1.3, 0.06);
  EXPECT_NEAR(walk->velocity.y(), 0.0, 0.06);
}

// The line of a person who is hidden in a part of the window is not refined to the last centimetre.
// Two people walk towards each other.
TEST(DetectWalk, FindsTheOneOfTwoWhoMayBeTheSubject) {
  const auto other_at = [](size_t frame) {
    return Eigen::Vector2d(0.7 - 1.2 * kDt * double(frame), 1.6);
  };
  const Window both = window([&](size_t f, const Eigen::Vector2d& p) {
    return bell(p, walker_at(f), 100) + bell(p, other_at(f), 120) - 20;
  });
  const auto any = both.walk();
  ASSERT_TRUE(any);
  EXPECT_LT((any->position - other_at(0)).norm(), 0.1);
  const auto walks_on = [](const DetectedWalk& line) { return line.velocity.x() > 0; };
  const auto subject = both.walk(1, walks_on);
  ASSERT_TRUE(subject);
  EXPECT_LT((subject->position - walker_at(0)).norm(), 0.1);
  EXPECT_FALSE(both.walk(1, [](const DetectedWalk&) { return false; }));
}

TEST(DetectWalk, DoesNotRefineLinesOfAHiddenPerson) {
  const auto scores_asked = [](size_t hidden_until) {
    int asked = 0;
    Window f = window([=](size_t frame, const Eigen::Vector2d& p) {
      return frame < hidden_until ? -5 : bell(p, walker_at(frame), 100);
    });
    // The early candidates for a person who is always visible: both propose the same lines.
    f.early = {{walker_at(window_ends(kWindowFrames).early), 100}};
    f.score = counted(f.score, asked);
    EXPECT_EQ(f.walk().has_value(), hidden_until == 0);
    return asked;
  };
  EXPECT_LT(scores_asked(6), 0.6 * scores_asked(0));
}

// The score of one camera: a ridge along the viewing ray, forty times as long as wide.
double ridge(const Eigen::Vector2d& place, const Eigen::Vector2d& truth, double height) {
  const Eigen::Vector2d from_eye = place - kEye, true_ray = truth - kEye;
  const double farther = from_eye.norm() / true_ray.norm() - 1;
  const double aside = std::remainder(
      std::atan2(from_eye.x(), from_eye.y()) - std::atan2(true_ray.x(), true_ray.y()), 2 * kPi);
  return height * std::exp(-0.5 * (std::pow(farther / 0.3, 2) + std::pow(aside / 0.008, 2)));
}

// Each end of a line has its own ray. A climb along one ray with both ends leaves the ridge.
TEST(DetectWalk, ClimbsAlongTheRayOfEitherEnd) {
  const auto truth = [](size_t frame) {
    return Eigen::Vector2d(-1.6 + 1.4 * kDt * double(frame), 0.4);
  };
  Window f =
      window([&](size_t frame, const Eigen::Vector2d& p) { return ridge(p, truth(frame), 100); });
  // The only candidate of the late frame is on its ray, but half as far again.
  const size_t late = window_ends(kWindowFrames).late;
  const Eigen::Vector2d far = kEye + 1.5 * (truth(late) - kEye);
  f.late = {{far, f.score(late, far, {}, {}).score}};
  const auto walk = f.walk();
  ASSERT_TRUE(walk);
  EXPECT_LT((walk->position - truth(0)).norm(), 0.05);
  EXPECT_NEAR(walk->velocity.y(), 0, 0.1);
}

// Behind a camera that looks at the first nobody is seen by it, and just before it every figure is
// a giant, so that a line behind it does not climb to the walker.
TEST(DetectWalk, TriesOtherDistancesThanThoseToWhichItClimbs) {
  constexpr double kFacing = 2.4;  // y of the other camera, m
  Window f = window([](size_t frame, const Eigen::Vector2d& p) {
    if (p.y() > kFacing) return ridge(p, kEye + 2 * (walker_at(frame) - kEye), 40);
    return (p.y() > 1 ? -300 : 0) + bell(p, walker_at(frame), 100);
  });
  const auto behind = [&](size_t frame) {
    return std::vector<Place>{{kEye + 2 * (walker_at(frame) - kEye), 40}};
  };
  const WindowEnds ends = window_ends(kWindowFrames);
  f.early = behind(ends.early);
  f.late = behind(ends.late);
  const auto walk = f.walk();
  ASSERT_TRUE(walk);
  EXPECT_LT((walk->position - walker_at(0)).norm(), 0.05);
}

// The places along the ray of somebody who stands propose lines, few of which are worth a whole
// climb.
TEST(DetectWalk, ClimbsLessAlongTheRayOfSomebodyWhoStands) {
  const auto scores_asked = [](double speed) {
    int asked = 0;
    Window f = window([=](size_t frame, const Eigen::Vector2d& p) {
      return ridge(p, {-0.8 + speed * kDt * double(frame), 0.4}, 100);
    });
    EXPECT_GT(f.early.size(), 1u);
    f.score = counted(f.score, asked);
    EXPECT_EQ(f.walk().has_value(), speed > 0);
    return asked;
  };
  EXPECT_LT(scores_asked(0), 0.5 * scores_asked(1.3));
}

TEST(DetectWalk, DoesNotClimbFromALineThroughSomebodyWhoStands) {
  Window f = window([](size_t, const Eigen::Vector2d& p) { return bell(p, {0, 1}, 100); });
  f.early = {{{0, 0.6}, 100}};
  f.late = {{{0, 1.4}, 100}};
  size_t asked = 0;
  f.score = counted(f.score, asked);
  EXPECT_FALSE(f.walk());
  EXPECT_LE(asked, 2 * kWindowFrames);
}

// Of eight figures the one that fits in a frame is found by the coarse steps of a climb.
TEST(DetectWalk, FineStepsTryTheFiguresThatFittedBest) {
  constexpr size_t kFigures = 8;
  const Window f =
      window([](size_t frame, const Eigen::Vector2d& p) { return bell(p, walker_at(frame), 100); });
  size_t stated = 0;
  Window of_eight = f;
  of_eight.score = [&](size_t frame, const Eigen::Vector2d& place, const Eigen::Vector2d& velocity,
                       std::optional<size_t> index) -> FigureInFrame {
    const size_t best = frame % kFigures;
    if (index) ++stated;
    const bool misfit = index && *index != best;
    return {misfit ? -100 : f.score(frame, place, velocity, index).score, best};
  };
  const auto walk = of_eight.walk(), same = f.walk();
  ASSERT_TRUE(walk && same);
  EXPECT_EQ(walk->position, same->position);
  EXPECT_EQ(walk->velocity, same->velocity);
  EXPECT_GT(stated, 0u);
}

// The fifth shift of a climb's first pattern leads to the walk from where it is .24 m farther away:
// five lines are tried, and afterwards neither where the climb came from nor, at the end, those
// that have failed since. Elsewhere a pattern has sixteen.
TEST(DetectWalk, AClimbTriesNoLineInVain) {
  const auto truth = [](size_t frame) {
    return Eigen::Vector2d(-0.8 + 1.25 * kDt * double(frame), 0.4);
  };
  const auto farther = [&](size_t frame, double by) -> Eigen::Vector2d {
    return truth(frame) + by * (truth(frame) - kEye).normalized();
  };
  const auto lines_tried = [&](double by) {
    Window f =
        window([&](size_t frame, const Eigen::Vector2d& p) { return bell(p, truth(frame), 100); });
    const WindowEnds ends = window_ends(kWindowFrames);
    const Eigen::Vector2d begin = farther(0, by), end = farther(kWindowFrames - 1, by);
    const auto between = [&](size_t frame) -> std::vector<Place> {
      return {{begin + double(frame) / double(kWindowFrames - 1) * (end - begin), 100}};
    };
    f.early = between(ends.early);
    f.late = between(ends.late);
    int lines = 0;
    f.score = [&lines, score = f.score](size_t frame, const Eigen::Vector2d& place,
                                        const Eigen::Vector2d& velocity,
                                        std::optional<size_t> index) {
      lines += frame == 0;
      return score(frame, place, velocity, index);
    };
    EXPECT_TRUE(f.walk());
    return lines;
  };
  EXPECT_EQ(lines_tried(0.24) - lines_tried(0), 5 + 15 - 16);
}

TEST(DetectWalk, NobodyWalks) {
  const Window empty = window([](size_t, const Eigen::Vector2d&) { return -5.0; });
  EXPECT_FALSE(empty.walk());
  const Window still = window([](size_t, const Eigen::Vector2d& p) {
    return bell(p, {0, 1}, 100);
  });
  EXPECT_FALSE(still.walk());
}

TEST(DetectWalk, AWalkerHiddenInPartOfTheFramesIsNotThereYet) {
  const Window f = window([](size_t frame, const Eigen::Vector2d& p) {
    return frame < 8 ? -1.0 : bell(p, walker_at(frame), 100);
  });
  EXPECT_FALSE(f.walk());
}

// Poses that no figure resembles last for a moment; hiding lasts longer.
TEST(DetectWalk, AMomentOfUnusualPosesIsTolerated) {
  const auto gap_of = [](size_t frames) {
    const Window f = window([=](size_t frame, const Eigen::Vector2d& p) {
      return (frame >= 10 && frame < 10 + frames ? 0.1 : 1) * bell(p, walker_at(frame), 100);
    });
    return f.walk();
  };
  EXPECT_TRUE(gap_of(2));
  EXPECT_FALSE(gap_of(5));
}

// The scores of somebody who comes out from behind a tree in the first fifth of a second.
TEST(DetectWalk, SaysForHowLongTheSubjectIsHalfHiddenAtFirst) {
  const auto seen = [](double first) {
    return window([=](size_t frame, const Eigen::Vector2d& p) {
      return bell(p, walker_at(frame), frame < 6 ? first : 100);
    });
  };
  const auto hidden = seen(52).walk(), dark = seen(90).walk();
  ASSERT_TRUE(hidden && dark);
  EXPECT_GE(hidden->hidden_frames, 4u);
  EXPECT_LE(hidden->hidden_frames, 6u);
  EXPECT_EQ(dark->hidden_frames, 0u);
}

TEST(DetectWalk, MovesAlongItsLineAndIsLessCertainThere) {
  const DetectedWalk walk{
      .position = {1, 2}, .velocity = {1.5, -0.5}, .position_sd = 0.03, .velocity_sd = 0.08};
  const DetectedWalk before = moved(walk, -0.5);
  EXPECT_LT((before.position - Eigen::Vector2d(0.25, 2.25)).norm(), 1e-12);
  EXPECT_NEAR(before.position_sd, 0.05, 1e-12);
  EXPECT_EQ(before.velocity_sd, walk.velocity_sd);
}

TEST(DetectWalk, ThreadsDoNotMatter) {
  const Window f =
      window([](size_t frame, const Eigen::Vector2d& p) { return bell(p, walker_at(frame), 100); });
  const auto one = f.walk();
  const auto many = f.walk(8);
  ASSERT_TRUE(one && many);
  EXPECT_EQ(one->position, many->position);
  EXPECT_EQ(one->velocity, many->velocity);
}

}  // namespace
}  // namespace walktrack
