#include "camera/world_frame.h"

#include <gtest/gtest.h>
#include <Eigen/LU>

#include "core/errors.h"
#include "tests/camera/sample_cameras.h"

namespace walktrack {
namespace {

using Eigen::Vector3d;

// Common axes: z up, y up (OpenSim), z down, tilted floors, normals of any length.
const std::vector<std::pair<Vector3d, double>> kGrounds{
    {{0, 0, 1}, 0},  {{0, 0, 1}, 0.4},        {{0, 1, 0}, -0.2},  {{0, 0, -1}, 0.1},
    {{1, 0, 0}, 1},  {{0.1, -0.05, 1}, 0.03}, {{1e-8, 0, -1}, 0}, {{0, 0, 2}, 1},
    {{0, -1, 0}, 0}, {{0.3, -0.9, 0.1}, -2}};

TEST(WorldFrame, PutsTheGroundAtZeroAndTheNormalUp) {
  for (const auto& [normal, offset] : kGrounds) {
    const WorldFrame frame = world_frame_on_ground(normal, offset);
    EXPECT_NEAR(frame.rotation.determinant(), 1, 1e-12);
    EXPECT_LT((frame.rotation * frame.rotation.transpose() - Eigen::Matrix3d::Identity()).norm(),
              1e-12);
    const Vector3d on_plane = normal * offset / normal.squaredNorm();
    EXPECT_NEAR(world_from_calibration(frame, on_plane).z(), 0, 1e-12);
    EXPECT_NEAR(world_from_calibration(frame, on_plane + normal.normalized()).z(), 1, 1e-12);
  }
}

TEST(WorldFrame, RoundTrips) {
  const Vector3d point(0.3, -2, 1.1);
  for (const auto& [normal, offset] : kGrounds) {
    const WorldFrame frame = world_frame_on_ground(normal, offset);
    EXPECT_LT((calibration_from_world(frame, world_from_calibration(frame, point)) - point).norm(),
              1e-12);
  }
}

TEST(WorldFrame, LeavesWorldAxesAlone) {
  const WorldFrame frame = world_frame_on_ground({0, 0, 1}, 0);
  EXPECT_EQ(frame.rotation, Eigen::Matrix3d::Identity());
  EXPECT_EQ(frame.translation, Vector3d::Zero());
}

TEST(WorldFrame, CameraSeesTheSamePixel) {
  const Camera camera = sample_camera(sample_lenses()[1]);
  const Vector3d point(0.2, 0.4, 0.8);
  for (const auto& [normal, offset] : kGrounds) {
    const WorldFrame frame = world_frame_on_ground(normal, offset);
    const Camera moved = camera_in_world(frame, camera);
    const auto seen = project(moved, world_from_calibration(frame, point));
    ASSERT_TRUE(seen);
    EXPECT_LT((*seen - *project(camera, point)).norm(), 1e-9);
    const Camera back = camera_in_calibration(frame, moved);
    EXPECT_LT((back.rotation - camera.rotation).norm(), 1e-12);
    EXPECT_LT((back.translation - camera.translation).norm(), 1e-12);
  }
}

TEST(WorldFrame, RefusesANormalWithoutDirection) {
  EXPECT_THROW(world_frame_on_ground(Vector3d::Zero(), 0), InputError);
  EXPECT_THROW(world_frame_on_ground(Vector3d::Constant(NAN), 0), InputError);
}

}  // namespace
}  // namespace walktrack
