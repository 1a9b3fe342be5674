#include "io/tables/kinetics_file.h"

#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "core/errors.h"
#include "io/archive/files.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;

TEST(KineticsFile, GroundForcesOfATableReadBack) {
  Kinetics written;
  for (int i = 0; i < 4; ++i) {
    KineticsFrame frame;
    frame.known = i != 2;
    frame.com.setZero();
    frame.feet[0].force = {1.0 * i, -2, 700};
    frame.feet[1].force = {0, 0.5, 10.0 * i};
    written.time.push_back(i / 30.0);
    written.frames.push_back(frame);
  }
  const fs::path file = fs::path(testing::TempDir()) / "kinetics.csv";
  write_file_atomically(file, simulated_kinetics_csv(written));
  const GroundForces read = read_ground_forces(file);
  ASSERT_EQ(read.time.size(), 4u);
  EXPECT_NEAR(read.time[3], 0.1, 1e-6);
  EXPECT_EQ(read.feet[3][0], Eigen::Vector3d(3, -2, 700));
  EXPECT_EQ(read.feet[3][1], Eigen::Vector3d(0, 0.5, 30));
  EXPECT_TRUE(std::isnan(read.feet[2][0].x()));
  write_file_atomically(file, "t,l_grf_x_n\n0,1\n");
  EXPECT_THROW(read_ground_forces(file), InputError);
  fs::remove(file);
}

}  // namespace
}  // namespace walktrack
