#include "io/c3d/c3d_file.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/io/c3d_reader.h"

namespace walktrack {
namespace {

using testing::ElementsAre;

constexpr double kUnknown = std::numeric_limits<double>::quiet_NaN();

// Joint j of row i at (i, j, 1), metres.
Motion numbered_motion(size_t rows, double from = 0) {
  Motion motion;
  for (size_t i = 0; i < rows; ++i) {
    motion.time.push_back(from + 0.02 * static_cast<double>(i));
    motion.joints.push_back(unknown_joints());
    for (size_t j = 0; j < kJointCountWithoutArms; ++j)
      motion.joints.back().at[j] = {0.01 * static_cast<double>(i), 0.1 * static_cast<double>(j), 1};
  }
  return motion;
}

std::vector<AngleRow> bent_rows(const Motion& motion) {
  std::vector<AngleRow> rows;
  for (const double time : motion.time) {
    Pose pose;
    pose.tilt = 0.1;
    pose.legs[0].knee_flexion = 0.5;
    pose.legs[1].hip_flexion = 0.3;
    pose.legs[1].ankle_dorsiflexion = -0.2;
    rows.push_back({time, pose, {}, {}});
  }
  return rows;
}

TEST(C3d, HoldsJointsInMillimetresWithTheirNamesRateAndUnits) {
  Motion motion = numbered_motion(7);
  motion.joints[3][Joint::kLeftKnee].y() = kUnknown;
  const ReadC3d file = read_c3d(c3d_from_motion({motion, 50, {}, {}}));
  EXPECT_EQ(file.points, kJointCountWithoutArms);
  EXPECT_EQ(file.first, 1);
  EXPECT_EQ(file.last, 7);
  EXPECT_EQ(file.rate, 50);
  EXPECT_EQ(file.at("POINT:RATE").numbers[0], 50);
  EXPECT_EQ(file.at("POINT:USED").numbers[0], file.points);
  EXPECT_EQ(file.at("POINT:FRAMES").numbers[0], 7);
  EXPECT_EQ(file.at("POINT:DATA_START").numbers[0], file.data_start);
  EXPECT_EQ(file.at("POINT:SCALE").numbers[0], file.scale);
  EXPECT_THAT(file.at("POINT:UNITS").texts, ElementsAre("mm"));
  EXPECT_EQ(file.data_start, 2 + file.blocks);
  EXPECT_EQ(file.bytes % 512, 0u);
  const auto& labels = file.at("POINT:LABELS").texts;
  ASSERT_EQ(labels.size(), size_t{kJointCountWithoutArms});
  EXPECT_EQ(labels[0], "pelvis");
  EXPECT_EQ(labels[4], "lknee");
  EXPECT_EQ(file.at("POINT:DESCRIPTIONS").texts.size(), labels.size());
  ASSERT_EQ(file.frames.size(), 7u);
  EXPECT_TRUE(file.frames[6][5].at.isApprox(Eigen::Vector3d(60, 500, 1000), 1e-6));
  EXPECT_EQ(file.frames[6][5].residual, 0);
  EXPECT_EQ(file.frames[3][4].residual, -1);
  EXPECT_EQ(file.frames[3][4].at, Eigen::Vector3d::Zero());
  EXPECT_EQ(file.analog, 0);
  EXPECT_EQ(file.at("FORCE_PLATFORM:USED").numbers[0], 0);
}

TEST(C3d, ArmsAreListedWhereTheyAreKnown) {
  Motion motion = numbered_motion(2);
  motion.joints[1][Joint::kRightWrist] = {1, 2, 3};
  const ReadC3d file = read_c3d(c3d_from_motion({motion, 50, {}, {}}));
  EXPECT_EQ(file.at("POINT:LABELS").texts.back(), "rwrist");
  EXPECT_EQ(file.frames[1].back().at, Eigen::Vector3d(1000, 2000, 3000));
  EXPECT_EQ(file.frames[0].back().residual, -1);
}

TEST(C3d, AnglesAreDegreesOnPointsOfTheirKind) {
  const Motion motion = numbered_motion(3);
  auto rows = bent_rows(motion);
  rows[1].pose.reset();
  const ReadC3d file = read_c3d(c3d_from_motion({motion, 50, rows, {}}));
  EXPECT_THAT(file.at("POINT:ANGLE_UNITS").texts, ElementsAre("deg"));
  const auto& labels = file.at("POINT:LABELS").texts;
  const auto angle = [&](const std::string& name, size_t frame) {
    const auto at = std::find(labels.begin(), labels.end(), name);
    EXPECT_NE(at, labels.end()) << name;
    return file.frames[frame][static_cast<size_t>(at - labels.begin())];
  };
  for (const std::string& name : file.at("POINT:ANGLES").texts) angle(name, 0);
  EXPECT_EQ(file.at("POINT:ANGLES").texts.size(), 8u);
  const double deg = 180 / std::numbers::pi;
  EXPECT_NEAR(angle("LKneeAngles", 0).at.x(), 0.5 * deg, 1e-4);
  EXPECT_NEAR(angle("RHipAngles", 2).at.x(), 0.3 * deg, 1e-4);
  EXPECT_NEAR(angle("RAnkleAngles", 2).at.x(), -0.2 * deg, 1e-4);
  EXPECT_NEAR(angle("PelvisAngles", 0).at.x(), 0.1 * deg, 1e-4) << "forwards is positive";
  EXPECT_EQ(angle("LKneeAngles", 1).residual, -1);
}

TEST(C3d, EventsHaveSidesNamesAndTimesFromTheFirstFrame) {
  const Motion motion = numbered_motion(5, 12.0);
  const std::vector<GaitEvent> events{{12.25, Side::kLeft, GaitEventKind::kFootStrike},
                                      {12.5, Side::kRight, GaitEventKind::kToeOff},
                                      {83.5, Side::kRight, GaitEventKind::kFootStrike}};
  const ReadC3d file = read_c3d(c3d_from_motion({motion, 50, {}, events}));
  EXPECT_EQ(file.at("EVENT:USED").numbers[0], 3);
  EXPECT_THAT(file.at("EVENT:CONTEXTS").texts, ElementsAre("Left", "Right", "Right"));
  EXPECT_THAT(file.at("EVENT:LABELS").texts, ElementsAre("Foot Strike", "Foot Off", "Foot Strike"));
  EXPECT_THAT(file.at("EVENT:TIMES").dimensions, ElementsAre(2, 3));
  EXPECT_THAT(file.at("EVENT:TIMES").numbers, ElementsAre(0, 0.25, 0, 0.5, 1, 11.5));
  EXPECT_THAT(file.at("EVENT_CONTEXT:LABELS").texts, ElementsAre("Left", "Right"));
}

TEST(C3d, MoreThan255EventsGoOnInASecondList) {
  const Motion motion = numbered_motion(2);
  std::vector<GaitEvent> events;
  for (int k = 0; k < 700; ++k)
    events.push_back({0.5 * k, k % 2 ? Side::kLeft : Side::kRight, GaitEventKind::kFootStrike});
  const ReadC3d file = read_c3d(c3d_from_motion({motion, 50, {}, events}));
  EXPECT_EQ(file.at("EVENT:LABELS").texts.size(), 255u);
  EXPECT_EQ(file.at("EVENT:LABELS3").texts.size(), 190u);
  EXPECT_EQ(file.all_texts("EVENT:CONTEXTS").size(), 700u);
  EXPECT_EQ(file.all_texts("EVENT:CONTEXTS")[699], "Left");
  const auto times = file.all_numbers("EVENT:TIMES");
  ASSERT_EQ(times.size(), 1400u);
  EXPECT_NEAR(60 * times[1398] + times[1399], 349.5, 1e-4);
}

TEST(C3d, AsManyEventsAsTheFormatCanHold) {
  const Motion motion = numbered_motion(2);
  const std::vector<GaitEvent> events(20000, {1, Side::kRight, GaitEventKind::kFootStrike});
  const ReadC3d file = read_c3d(c3d_from_motion({motion, 50, {}, events}));
  EXPECT_GT(file.at("EVENT:USED").numbers[0], 3000);
  EXPECT_EQ(file.all_texts("EVENT:LABELS").size(), file.at("EVENT:USED").numbers[0]);
}

TEST(C3d, LongMotionsHaveMoreFramesThanTheHeaderCanCount) {
  const Motion motion = numbered_motion(70000);
  const ReadC3d file = read_c3d(c3d_from_motion({motion, 50, {}, {}}));
  EXPECT_EQ(file.last, 65535);
  EXPECT_EQ(file.at("POINT:LONG_FRAMES").numbers[0], 70000);
  ASSERT_EQ(file.frames.size(), 70000u);
  EXPECT_NEAR(file.frames.back()[0].at.x(), 699990, 0.1);
}

// Mokka and ezc3d show the stored vector in the laboratory's axes.
TEST(C3d, PlatesGiveForcesCentresAndFreeMomentsBack) {
  const Motion motion = numbered_motion(3);
  Kinetics forces;
  forces.time = motion.time;
  forces.frames.resize(3);
  forces.frames[1].known = true;
  FootLoad& left = forces.frames[1].feet[0];
  left.force = {40, -15, 650};
  left.centre = {0.31, 0.12};
  left.free_moment = 4;
  const ReadC3d file = read_c3d(c3d_from_motion({motion, 50, {}, {}, &forces}));
  EXPECT_EQ(file.analog, 12);
  EXPECT_EQ(file.samples, 1);
  EXPECT_EQ(file.at("FORCE_PLATFORM:USED").numbers[0], 2);
  EXPECT_THAT(file.at("FORCE_PLATFORM:TYPE").numbers, ElementsAre(2, 2));
  EXPECT_THAT(file.at("ANALOG:LABELS").texts, testing::Contains("Fz2"));
  EXPECT_THAT(file.at("ANALOG:UNITS").texts, testing::Contains("Nmm"));
  const PlateReading reading = read_plate(file, 0, 1);
  EXPECT_TRUE(reading.force.isApprox(Eigen::Vector3d(40, -15, 650), 1e-5));
  EXPECT_TRUE(reading.centre.isApprox(Eigen::Vector3d(310, 120, 0), 1e-4))
      << reading.centre.transpose();
  EXPECT_NEAR(reading.free_moment, 4000, 1);
  for (const size_t frame : {0u, 2u})
    for (const double each : file.channels[frame]) EXPECT_EQ(each, 0);
  for (size_t k = 6; k < 12; ++k) EXPECT_EQ(file.channels[1][k], 0) << "the right foot swings";
}

}  // namespace
}  // namespace walktrack
