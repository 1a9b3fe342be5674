// Real videos with their references, if their data are beside the checkout.
#include <cmath>
#include <filesystem>
#include <limits>
#include <string>
#include <tuple>
#include <vector>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "io/tables/motion_file.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;

struct Landing {
  Side side;
  size_t frame;
  Vector2d toe;  // m
};

// toe_plants.csv of the man who stands, walks towards two telephones and stands.
constexpr size_t kSetsOff = 125, kStandsAgain = 310;
const std::vector<Landing> kLandings{{Side::kRight, 145, {-1.021, -0.007}},
                                     {Side::kLeft, 185, {-0.430, 0.120}},
                                     {Side::kRight, 225, {0.151, 0.048}},
                                     {Side::kLeft, 260, {0.657, 0.140}}};

// The mean place of a toe from 6 to 13 frames after a landing.
Vector2d toe_after(const Motion& motion, size_t frame, Side side) {
  Vector2d sum = Vector2d::Zero();
  for (size_t i = frame + 6; i < frame + 14; ++i) sum += motion.joints[i][toe(side)].head<2>() / 8;
  return sum;
}

// With images of the empty room, and with nothing but the two videos, in which he stands for more
// than half of the time: the background behind his first place is never seen, so that his first
// step is less certain.
struct Room {
  const char* scene;
  double farthest;  // m
};
class TwoTelephones : public testing::TestWithParam<std::tuple<Room, int>> {};

TEST_P(TwoTelephones, AManStandsWalksAndStands) {
  const fs::path scene = fs::path(WALKTRACK_SOURCE_DIR) / "../shared/data/opencap_two_phones" /
                         std::get<0>(GetParam()).scene;
  if (!fs::exists(scene)) GTEST_SKIP() << "no ../shared/data/opencap_two_phones";
  const TemporaryFolder out;
  const std::string folder = out / "result";
  const ProgramResult run = run_walktrack({"track", scene.string(), "-o", folder, "--no-overlay",
                                           "--seed", std::to_string(std::get<1>(GetParam()))});
  ASSERT_TRUE(run.exit_code == 0 || run.exit_code == 4) << run.err;
  const Motion motion = read_motion(folder + "/joints.csv");
  const auto record = nlohmann::json::parse(read_file(folder + "/run.json"));
  const auto& standing = record["by_frame"]["standing"];
  ASSERT_EQ(standing.size(), motion.time.size());
  size_t stood = 0;
  for (size_t i = 0; i < kSetsOff - 25; ++i)
    stood += !standing[i].is_null() && standing[i].get<double>() > 0.5;
  EXPECT_GE(stood, 9 * (kSetsOff - 25) / 10);
  for (const Landing& landing : kLandings) {
    const Vector2d own = toe_after(motion, landing.frame, landing.side) - landing.toe;
    const Vector2d other_foot = toe_after(motion, landing.frame, other(landing.side)) - landing.toe;
    EXPECT_LT(own.norm(), other_foot.norm()) << landing.frame;
    // The toe of the body model is the ball, about 8 cm behind the tip that was marked.
    EXPECT_LT(own.norm(), std::get<0>(GetParam()).farthest) << landing.frame;
  }
  const auto gait = nlohmann::json::parse(read_file(folder + "/gait.json"));
  for (const auto& event : gait["events"]) {
    EXPECT_GT(event["time_s"]["value"].get<double>(), (kSetsOff - 10) / 60.0);
    EXPECT_LT(event["time_s"]["value"].get<double>(), (kStandsAgain + 10) / 60.0);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, TwoTelephones,
                         testing::Combine(testing::Values(Room{"scene_plates.yaml", 0.15},
                                                          Room{"scene.yaml", 0.25}),
                                          testing::Values(1, 2, 3)));

}  // namespace
}  // namespace walktrack
