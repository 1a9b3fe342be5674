#include "io/tables/marker_file.h"

#include <cmath>

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "core/errors.h"
#include "io/c3d/c3d_file.h"
#include "io/c3d/c3d_read.h"
#include "io/tables/motion_file.h"
#include "io/tables/opensim.h"
#include "io/tables/trc_read.h"
#include "tests/message_of.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

using Eigen::Vector3d;
using testing::HasSubstr;

const std::string kTruth = std::string(WALKTRACK_SOURCE_DIR) + "/data/demo/truth.csv";

void expect_same(const Motion& expected, const Motion& found, double tolerance) {
  ASSERT_EQ(found.time.size(), expected.time.size());
  for (size_t i = 0; i < expected.time.size(); ++i) {
    EXPECT_NEAR(found.time[i] - found.time[0], expected.time[i] - expected.time[0], 1e-5);
    for (size_t j = 0; j < kJointCountWithoutArms; ++j)
      EXPECT_LT((found.joints[i].at[j] - expected.joints[i].at[j]).norm(), tolerance)
          << i << " " << kJointNames[j];
  }
}

TEST(MarkerFile, OurOwnFilesComeBackAsTheyWere) {
  const Motion motion = read_motion(kTruth);
  const TemporaryFolder place;
  place.write("a.trc", trc_from_motion(motion, 30, "a"));
  expect_same(motion, read_motion(place / "a.trc"), 2e-6);
  place.write("a.C3D", c3d_from_motion({motion, 30, {}, {}}));
  expect_same(motion, read_motion(place / "a.C3D"), 2e-6);
}

TEST(MarkerFile, UnknownPointsStayUnknown) {
  Motion motion = read_motion(kTruth);
  motion.joints[3][Joint::kLeftKnee].setConstant(NAN);
  const TemporaryFolder place;
  place.write("a.trc", trc_from_motion(motion, 30, "a"));
  place.write("a.c3d", c3d_from_motion({motion, 30, {}, {}}));
  for (const char* name : {"a.trc", "a.c3d"}) {
    const Motion found = read_motion(place / name);
    EXPECT_FALSE(known(found.joints[3][Joint::kLeftKnee])) << name;
    EXPECT_TRUE(known(found.joints[4][Joint::kLeftKnee])) << name;
  }
}

// A row of markers: name and place, m.
MarkerTable table(const std::vector<std::pair<std::string, Vector3d>>& points) {
  MarkerTable out{"m.trc", {}, {0, 0.01}, {{}, {}}};
  for (const auto& [name, at] : points) {
    out.names.push_back(name);
    for (auto& row : out.points) row.push_back(at);
  }
  return out;
}

// Pose2Sim and OpenCap: y up, z to the right of x.
TEST(Markers, OfOpenSimsAxesStandUp) {
  const MarkerTable markers = table({{"RHip", {1, 0.9, 0.1}},
                                     {"LHip", {1, 0.9, -0.1}},
                                     {"RKnee", {1, 0.5, 0.1}},
                                     {"LKnee", {1, 0.5, -0.1}},
                                     {"RAnkle", {1, 0.1, 0.1}},
                                     {"LAnkle", {1, 0.1, -0.1}},
                                     {"RBigToe", {1.2, 0.02, 0.1}},
                                     {"LBigToe", {1.2, 0.02, -0.1}},
                                     {"Nose", {1.1, 1.6, 0}}});
  const JointPositions joints = motion_from_markers(markers).joints[1];
  EXPECT_TRUE(joints[Joint::kRightKnee].isApprox(Vector3d(1, -0.1, 0.5)));
  EXPECT_TRUE(joints[Joint::kLeftToe].isApprox(Vector3d(1.2, 0.1, 0.02)));
  EXPECT_TRUE(joints[Joint::kPelvis].isApprox(Vector3d(1, 0, 0.9)));
  EXPECT_FALSE(known(joints[Joint::kHead]));
}

// A Plug-in Gait set with medial markers, z up, with a subject's prefix; hips by Harrington: for a
// pelvis 240 mm wide and 160 mm deep they are 48.3 mm behind the midpoint of the spines, 82.9 mm
// below it and 86.5 mm to the side.
TEST(Markers, OfASkinSetBecomeJointCentres) {
  std::vector<std::pair<std::string, Vector3d>> points{{"Anna:LASI", {0, 0.12, 1}},
                                                       {"Anna:RASI", {0, -0.12, 1}},
                                                       {"Anna:LPSI", {-0.16, 0.05, 1}},
                                                       {"Anna:RPSI", {-0.16, -0.05, 1}}};
  for (const auto& [letter, y] : {std::pair{"L", 0.1}, {"R", -0.1}})
    for (const auto& [name, side, z] : {std::tuple{"KNE", 0.05, 0.5},
                                        {"KNM", -0.05, 0.5},
                                        {"ANK", 0.04, 0.1},
                                        {"ANM", -0.04, 0.1}})
      points.emplace_back(fmt::format("Anna:{}{}", letter, name),
                          Vector3d(0, y + (y > 0 ? side : -side), z));
  const JointPositions joints = motion_from_markers(table(points)).joints[0];
  EXPECT_TRUE(joints[Joint::kLeftHip].isApprox(Vector3d(-0.0483, 0.0865, 1 - 0.0829), 1e-9))
      << joints[Joint::kLeftHip].transpose();
  EXPECT_TRUE(joints[Joint::kRightKnee].isApprox(Vector3d(0, -0.1, 0.5)));
  EXPECT_TRUE(joints[Joint::kLeftAnkle].isApprox(Vector3d(0, 0.1, 0.1)));
}

TEST(Markers, SayWhichJointsAreMissing) {
  const auto trouble = [](const MarkerTable& markers) {
    return message_of([&] { motion_from_markers(markers); });
  };
  EXPECT_THAT(
      trouble(table({{"LKNE", {0, 0, 1}}, {"LHJC", {0, 0, 1}}})),
      HasSubstr("m.trc: found 2 points without the right hip, the left knee, the right knee"));
  EXPECT_THAT(trouble(table({{"LHip", {0, 0, 0}},
                             {"RHip", {0, 0, 0}},
                             {"LKnee", {0, 0, 0.4}},
                             {"RKnee", {0, 0, 0.4}},
                             {"LAnkle", {0, 0, 0.8}},
                             {"RAnkle", {0, 0, 0.8}}})),
              HasSubstr("-0.80 along z, allowed: somebody upright"));
}

TEST(Trc, SaysWhereItIsWrong) {
  const std::string good =
      "PathFileType\t4\t(X/Y/Z)\ta.trc\nDataRate\tUnits\n100\tmm\nFrame#\tTime\tLHip\t\t\n"
      "\t\tX1\tY1\tZ1\n1\t0.00\t1\t2\t3\n2\t0.01\t1\t\tnan\n";
  const MarkerTable read = markers_from_trc(good, "a.trc");
  EXPECT_EQ(read.points[0][0], Vector3d(0.001, 0.002, 0.003));
  EXPECT_TRUE(std::isnan(read.points[1][0].y()) && std::isnan(read.points[1][0].z()));
  const auto trouble = [&](const std::string& old_text, const std::string& new_text) {
    std::string text = good;
    text.replace(text.find(old_text), old_text.size(), new_text);
    return message_of([&] { markers_from_trc(text, "a.trc"); });
  };
  EXPECT_THAT(trouble("PathFileType", "x"), HasSubstr("a.trc:1: found another heading"));
  EXPECT_THAT(trouble("mm", "ft"), HasSubstr("a.trc:3: found the unit 'ft', allowed: m, cm or mm"));
  EXPECT_THAT(trouble("0.01", "0.00"),
              HasSubstr("a.trc:7: found the time 0.00, allowed: times that"));
  EXPECT_THAT(trouble("\t2\t3", "\ttwo\t3"), HasSubstr("a.trc:6: found 'two', allowed: a number"));
  EXPECT_THAT(trouble("Frame#", "Row"), HasSubstr("a.trc:4: found 'Row'"));
}

TEST(C3dRead, SurvivesWhatIsCutOffOrChanged) {
  const Motion motion = read_motion(kTruth);
  const std::string good = c3d_from_motion({motion, 30, {}, {}});
  EXPECT_THAT(message_of([] { markers_from_c3d("short", "a.c3d"); }), HasSubstr("a.c3d: found"));
  EXPECT_THAT(message_of([&] { markers_from_c3d(good.substr(0, good.size() / 2), "a.c3d"); }),
              HasSubstr("of 121 frames, allowed: a whole C3D file"));
  std::string other = good;
  other[512 + 3] = 86;  // MIPS
  EXPECT_THAT(message_of([&] { markers_from_c3d(other, "a.c3d"); }),
              HasSubstr("another processor"));
  // Any change of a byte in header and parameters leads to numbers or to an error.
  for (size_t at = 0; at < 2048; ++at) {
    std::string changed = good;
    changed[at] = static_cast<char>(changed[at] ^ 0x55);
    try {
      markers_from_c3d(changed, "a.c3d");
    } catch (const InputError&) {
      continue;
    }
  }
}

}  // namespace
}  // namespace walktrack
