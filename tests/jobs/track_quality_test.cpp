#include "jobs/track/report/track_quality.h"

#include <algorithm>
#include <cmath>
#include <regex>
#include <stdexcept>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "io/archive/files.h"
#include "jobs/track/report/quality_words.h"
#include "tests/metrics/test_walk.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

constexpr double kLeg = 0.9;  // m

FrameRecord still() {
  FrameRecord record;
  record.tracked = true;
  record.estimate.joint_count = kJointCountWithoutArms;
  for (Eigen::Vector3d& joint : record.estimate.joints.at) joint.setZero();
  return record;
}

class QualityOf : public testing::Test {
 protected:
  // A figure with the values of `record` in every frame, tracked except in the frames listed.
  TrackedFrames standing(int count, std::initializer_list<int> lost,
                         const FrameRecord& record = still()) const {
    TrackedFrames frames{30, FrameFile(folder_ / ("frames" + std::to_string(files_++)))};
    for (int i = 0; i < count; ++i) {
      FrameRecord each = record;
      each.tracked = std::ranges::find(lost, i) == lost.end();
      frames.records.append(each);
    }
    return frames;
  }
  TemporaryFolder folder_;
  mutable int files_ = 0;
};

// The quality of a track whose feet were not planted.
Quality quality_of(const TrackedFrames& frames, const QualityConfig& limits = {}) {
  return walktrack::quality_of(frames, frames, limits, kLeg);
}

const QualityMeasure& named(const Quality& quality, const std::string& name) {
  for (const QualityMeasure& m : quality)
    if (m.name == name) return m;
  throw std::out_of_range(name);
}

TEST_F(QualityOf, CountsLostFramesFromTheFirstTrackedOneOn) {
  const Quality quality = quality_of(standing(12, {0, 1, 5, 6}));
  EXPECT_DOUBLE_EQ(named(quality, "lost_percent").value, 20);
  EXPECT_FALSE(named(quality, "lost_percent").passed());
}

// Somebody walks out of the picture, and back into it after a while. Until they are found again,
// the frames in which they move are lost.
TEST_F(QualityOf, NobodyIsLostOutOfThePicture) {
  const auto passes = [&](bool seen_to_leave) {
    TrackedFrames frames{30, FrameFile(folder_ / "passes")};
    for (int i = 0; i < 20; ++i) {
      FrameRecord record = still();
      record.tracked = i < 8 || i >= 16;
      record.out_of_picture = seen_to_leave && (i == 8 || i == 9);
      record.moving = i >= 14 && i < 16 ? 0.5 : 0;
      frames.records.append(record);
    }
    return frames;
  };
  EXPECT_EQ(frames_out_of_picture(passes(true)), 6);
  EXPECT_DOUBLE_EQ(named(quality_of(passes(true)), "lost_percent").value, 100 * 2 / 14.0);
  EXPECT_EQ(frames_out_of_picture(passes(false)), 0) << "hidden, not gone";
  EXPECT_DOUBLE_EQ(named(quality_of(passes(false)), "lost_percent").value, 100 * 8 / 20.0);
}

TEST_F(QualityOf, NobodyTrackedLosesNothing) {
  EXPECT_EQ(named(quality_of(standing(2, {0, 1})), "lost_percent").value, 0);
  EXPECT_EQ(named(quality_of(standing(0, {})), "leg_swaps_per_min").value, 0);
}

// Four frames of a stride are needed to follow which leg is which.
TEST_F(QualityOf, TooFewFramesASecondFailTheirCheck) {
  for (const double rate : {1.0, 3.0, 4.9, 5.0, 7.0}) {
    TrackedFrames frames = standing(12, {});
    frames.frame_rate = rate;
    EXPECT_EQ(named(quality_of(frames), "frame_rate_hz").passed(), rate >= 5) << rate;
  }
}

// Of results with a fifth of doubt and more, two of five have swapped legs.
TEST_F(QualityOf, LegsThatAreLikelySwappedFailTheirCheck) {
  QualityConfig limits;
  limits.least_steps = 0;
  for (const double probability : {0.15, 0.25}) {
    FrameRecord doubtful = still();
    doubtful.modes.p_legs_swapped = probability;
    const Quality quality = quality_of(standing(12, {}, doubtful), limits);
    EXPECT_NEAR(named(quality, "legs_exchanged_percent").value, 100 * probability, 1e-9);
    EXPECT_EQ(named(quality, "legs_exchanged_percent").passed(), probability < 0.2);
  }
}

TEST_F(QualityOf, FeetBelowTheGroundFailTheirCheck) {
  FrameRecord sunken = still();
  sunken.estimate.joints[Joint::kLeftToe].z() = -0.02;
  const TrackedFrames frames = standing(12, {}, sunken);
  QualityConfig limits;
  limits.least_steps = 0;
  limits.penetration = 0.015;
  const Quality quality = quality_of(frames, limits);
  EXPECT_DOUBLE_EQ(named(quality, "penetration_mm").value, 20);
  EXPECT_THAT(first_failure(quality),
              testing::HasSubstr("held in place: 20 mm (allowed: at most 15)"));
  limits.penetration = 0.025;
  EXPECT_EQ(first_failure(quality_of(frames, limits)), "");
}

// Planted feet hide the errors of a track that fails.
TEST_F(QualityOf, LimitsOnFeetAreForWhatWasTracked) {
  FrameRecord sunken = still();
  sunken.estimate.joints[Joint::kLeftToe].z() = -0.02;
  const TrackedFrames moving = standing(12, {}, sunken), planted = standing(12, {}, still());
  QualityConfig limits;
  limits.least_steps = 0;
  limits.penetration = 0.015;
  limits.foot_slide = 0.07;
  const Quality quality = walktrack::quality_of(planted, moving, limits, kLeg);
  EXPECT_EQ(named(quality, "penetration_mm").value, 0);
  EXPECT_TRUE(named(quality, "penetration_mm").passed());
  EXPECT_FALSE(named(quality, "tracked_penetration_mm").passed());
  EXPECT_EQ(*named(quality, "tracked_slide_along_walk_mm").limit, 70);
}

// If somebody walks for half a video before the start, half of the video is lost.
TEST_F(QualityOf, UntrackedMotionCountsFromTheFirstFrameOn) {
  TrackedFrames frames{30, FrameFile(folder_ / "moving")};
  for (int i = 0; i < 20; ++i) {
    FrameRecord record = still();
    record.tracked = i >= 10;
    record.moving = i < 6 || i >= 10 ? 0.5 : 0.01;
    frames.records.append(record);
  }
  const QualityMeasure measure = named(quality_of(frames), "untracked_movement_percent");
  EXPECT_DOUBLE_EQ(measure.value, 100 * 6 / 16.0);
  EXPECT_FALSE(measure.passed());
  EXPECT_EQ(named(quality_of(frames), "lost_percent").value, 0);
  EXPECT_EQ(named(quality_of(standing(9, {0, 1, 2})), "untracked_movement_percent").value, 0)
      << "nobody there";
}

TEST_F(QualityOf, AFigureBesideThePersonFailsInTheWorstCamera) {
  FrameRecord beside = still();
  beside.fit.overlap = {0.8, 0.4, std::nan("")};
  beside.fit.seen = {1, 0.5, 0};
  const Quality quality = quality_of(standing(4, {1}, beside));
  EXPECT_NEAR(named(quality, "overlap_percent").value, 40, 1e-9);
  EXPECT_FALSE(named(quality, "overlap_percent").passed());
  beside.fit.overlap = {0.8, 0.75, std::nan("")};
  EXPECT_TRUE(named(quality_of(standing(4, {}, beside)), "overlap_percent").passed());
  EXPECT_THROW(named(quality_of(standing(4, {})), "overlap_percent"), std::out_of_range)
      << "no silhouettes";
}

// While a subject stands before a background that was never seen, hardly anything is known of them.
TEST_F(QualityOf, FramesInWhichLittleOfTheFigureIsSeenCountForLittle) {
  FrameRecord hardly = still(), whole = still();
  hardly.fit = {.overlap = {0.1}, .seen = {0.05}};
  whole.fit = {.overlap = {0.8}, .seen = {0.95}};
  TrackedFrames frames = standing(3, {}, hardly);
  const TrackedFrames later = standing(3, {}, whole);
  for (const FrameRecord& record : later.records) frames.records.append(record);
  EXPECT_NEAR(named(quality_of(frames), "overlap_percent").value, 100 * (0.1 * 0.05 + 0.8 * 0.95),
              1e-9);
}

TEST_F(QualityOf, EvidenceForAFigureBesideThisOneFails) {
  FrameRecord beside = still();
  beside.fit.better_beside = 0.3;
  EXPECT_NEAR(named(quality_of(standing(4, {1}, beside)), "better_beside_nats").value, 0.3, 1e-9);
  EXPECT_FALSE(named(quality_of(standing(4, {}, beside)), "better_beside_nats").passed());
}

TEST(QualityOfKeypoints, AFigureBesideThePeopleDetectedFails) {
  const QualityConfig limits;
  EXPECT_FALSE(quality_of_keypoints({}, limits)) << "no keypoints";
  EXPECT_FALSE(quality_of_keypoints({.frames = 4}, limits)) << "too few";
  const auto wrong = quality_of_keypoints({.frames = 55, .matched = 22}, limits);
  ASSERT_TRUE(wrong);
  EXPECT_NEAR(wrong->value, 40, 1e-9);
  EXPECT_FALSE(wrong->passed());
  EXPECT_TRUE(quality_of_keypoints({.frames = 27, .matched = 21}, limits)->passed());
}

// A person who walks for four seconds, modified by `change`.
template <typename Change>
TrackedFrames walking(const std::filesystem::path& file, const TestWalk& walk,
                      const Change& change) {
  TrackedFrames frames{walk.rate, FrameFile(file)};
  for (int i = 0; i < static_cast<int>(4 * walk.rate); ++i) {
    FrameRecord record = still();
    record.estimate.joints = walk_joints(walk, i / walk.rate);
    for (Eigen::Vector3d& joint : record.estimate.joints.at)
      if (!joint.allFinite()) joint.setZero();  // those that the walk does not define
    change(i / walk.rate, record.estimate.joints);
    frames.records.append(record);
  }
  return frames;
}

TEST_F(QualityOf, SomebodyWhoWalksPasses) {
  const TrackedFrames frames = walking(folder_ / "walk", {}, [](double, JointPositions&) {});
  QualityConfig limits;
  limits.least_steps = 0;
  EXPECT_EQ(first_failure(quality_of(frames, limits)), "");
}

TEST_F(QualityOf, FeetThatGoElsewhereThanTheBodyFail) {
  const TrackedFrames frames = walking(
      folder_ / "hasty", {},
      [](double time, JointPositions& joints) { joints[Joint::kPelvis].x() += 0.6 * time; });
  EXPECT_FALSE(named(quality_of(frames), "steps_off_way_percent").passed());
}

TEST_F(QualityOf, ABodyThatMovesOnWithoutStepsFails) {
  const TrackedFrames frames = walking(folder_ / "gliding", {}, [](double, JointPositions& joints) {
    for (const Joint joint :
         {Joint::kLeftAnkle, Joint::kLeftToe, Joint::kRightAnkle, Joint::kRightToe})
      joints[joint].x() = joints[Joint::kPelvis].x();
  });
  EXPECT_FALSE(named(quality_of(frames), "missing_steps").passed());
}

TEST_F(QualityOf, StepsAndSpeedsThatNobodyWalksFail) {
  const auto nothing = [](double, JointPositions&) {};
  const Quality fast = quality_of(walking(folder_ / "fast", {.speed = 3}, nothing));
  EXPECT_FALSE(named(fast, "longest_step_leg_lengths").passed());
  EXPECT_FALSE(named(fast, "fastest_m_s").passed());
  // A foot that lands behind the other one.
  const auto dragged = [](double, JointPositions& joints) {
    for (const Joint joint : {Joint::kLeftKnee, Joint::kLeftAnkle, Joint::kLeftToe})
      joints[joint].x() -= 0.9;
  };
  const Quality behind = quality_of(walking(folder_ / "behind", {}, dragged));
  EXPECT_FALSE(named(behind, "shortest_step_m").passed());
  EXPECT_EQ(*named(behind, "shortest_step_m").limit, 0);
}

// The readers of a report get an explanation and advice for every failed check; the guide lists
// them all.
TEST(QualityWords, EveryCheckIsExplained) {
  const std::string guide =
      read_text_file(WALKTRACK_SOURCE_DIR "/apps/guide/quality.md", size_t{1} << 20);
  for (const QualityWords& words : quality_words()) {
    EXPECT_TRUE(words.meaning.ends_with('.')) << words.name;
    // Keys are in brackets; no other names of code are for readers.
    for (const std::string_view text : {words.meaning, words.advice})
      EXPECT_EQ(std::regex_replace(std::string(text), std::regex(R"(\([^)]*\))"), "").find('_'),
                std::string::npos)
          << words.name;
    if (words.advice.empty()) continue;
    EXPECT_TRUE(words.advice.ends_with('.') || words.advice.ends_with('?')) << words.name;
    EXPECT_THAT(guide, testing::HasSubstr(words.what)) << words.name;
  }
}

TEST_F(QualityOf, EveryCheckHasAdvice) {
  FrameRecord seen = still();
  seen.fit.overlap = {0.8};
  seen.fit.seen = {1};
  for (const QualityMeasure& m : quality_of(standing(4, {}, seen))) {
    EXPECT_FALSE(m.meaning.empty()) << m.name;
    EXPECT_EQ(m.limit.has_value(), !m.advice.empty()) << m.name;
  }
}

TEST_F(QualityOf, StandingIsNoWalk) {
  const Quality quality = quality_of(standing(12, {}));
  EXPECT_THAT(first_failure(quality), testing::HasSubstr("(allowed: at least 1)"));
}

}  // namespace
}  // namespace walktrack
