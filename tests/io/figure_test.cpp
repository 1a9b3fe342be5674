#include "io/figure/animated_figure.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "body/kinematics.h"
#include "io/figure/bvh_file.h"
#include "io/figure/glb_file.h"
#include "tests/io/bvh_reader.h"
#include "tests/io/glb_reader.h"

namespace walktrack {
namespace {

using Eigen::Vector3d;

constexpr double kUnseen = std::numeric_limits<double>::quiet_NaN();
constexpr double kRate = 25;

// OpenSim's axes: (x, z, -y) of the world.
Vector3d in_file(const Vector3d& world) { return {world.x(), world.z(), -world.y()}; }

Pose bent_pose(double s) {
  Pose pose;
  pose.root = {1.2 * s, 0.3 * std::sin(s), 0.9 + 0.03 * std::cos(2 * s)};
  pose.heading = 1.9 * s;  // more than a whole turn
  pose.list = 0.1 * std::sin(s);
  pose.tilt = 0.2;
  pose.legs[0] = {0.5 * std::sin(s), 0.1, 0.2, 0.6 + 0.5 * std::cos(s), 0.2 * std::sin(3 * s)};
  pose.legs[1] = {-0.5 * std::sin(s), 0.05, -0.1, 0.6 - 0.5 * std::cos(s), -0.1};
  pose.arms[0] = {0.4 * std::sin(s), 0.3, 0.5};
  pose.arms[1] = {-0.4 * std::sin(s), 1.5, 0.2 + 0.2 * std::cos(s)};
  return pose;
}

struct Made {
  Body body;
  Motion motion;
};

Made made(size_t rows, bool arms) {
  Made out{make_body({.height = 1.68, .mass = 60, .lengths = {}}, {.head = true, .arms = arms}),
           {}};
  for (size_t i = 0; i < rows; ++i) {
    out.motion.time.push_back(static_cast<double>(i) / kRate);
    out.motion.joints.push_back(unknown_joints());
    const Skeleton skeleton = forward_kinematics(out.body, bent_pose(0.2 * static_cast<double>(i)));
    for (size_t j = 0; j < static_cast<size_t>(arms ? kJointCount : kJointCountWithoutArms); ++j)
      out.motion.joints.back().at[j] = skeleton.joints.at[j];
  }
  return out;
}

std::string bvh_name(Joint joint) {
  switch (joint) {
    case Joint::kHead:
      return "neck/end";
    case Joint::kLeftToe:
      return "lankle/end";
    case Joint::kRightToe:
      return "rankle/end";
    case Joint::kLeftWrist:
      return "lelbow/end";
    case Joint::kRightWrist:
      return "relbow/end";
    default:
      return std::string(kJointNames[static_cast<size_t>(joint)]);
  }
}

// Greatest distance of known joints, m.
double bvh_error(const ReadBvh& file, const Motion& motion, size_t row) {
  double worst = 0;
  const auto places = file.places(row);
  for (size_t j = 0; j < kJointCount; ++j)
    if (const Vector3d& joint = motion.joints[row].at[j]; joint.allFinite())
      worst = std::max(worst, (places.at(bvh_name(static_cast<Joint>(j))) - in_file(joint)).norm());
  return worst;
}

double glb_error(const ReadGlb& file, const Motion& motion, size_t row) {
  double worst = 0;
  const GlbPose pose = file.at(motion.time[row] + 1e-7);  // a key is a float
  for (size_t j = 0; j < kJointCount; ++j)
    if (const Vector3d& joint = motion.joints[row].at[j]; joint.allFinite())
      worst = std::max(worst, (pose.place(std::string(kJointNames[j])) - in_file(joint)).norm());
  return worst;
}

TEST(AnimatedFigure, JointsAreWhereTheMotionHasThem) {
  for (const bool arms : {false, true}) {
    const Made walk = made(40, arms);
    const AnimatedFigure figure = animated_figure(walk.motion, walk.body.lengths);
    EXPECT_EQ(figure.nodes.size(), arms ? 18u : 12u);
    const ReadBvh bvh = read_bvh(bvh_from_figure(figure, kRate));
    const std::string bytes = glb_from_figure(figure, walk.body.subject);
    const ReadGlb glb(bytes);
    EXPECT_NEAR(bvh.frame_time, 1 / kRate, 1e-9);
    ASSERT_EQ(bvh.frames.size(), 40u);
    for (size_t row = 0; row < 40; ++row) {
      EXPECT_LT(bvh_error(bvh, walk.motion, row), 2e-5) << row;  // every joint is rounded to 1e-6
      EXPECT_LT(glb_error(glb, walk.motion, row), 1e-5) << row;
    }
  }
}

TEST(AnimatedFigure, StandsUprightAtRestAndLooksAlongX) {
  const Made walk = made(20, true);
  const AnimatedFigure figure = animated_figure(walk.motion, walk.body.lengths);
  const auto rest = rest_places(figure, walk.body.lengths.ankle_height);
  for (size_t i = 0; i < figure.nodes.size(); ++i) {
    Pose upright;
    upright.root.z() = leg_length(walk.body.lengths);
    const Skeleton skeleton = forward_kinematics(walk.body, upright);
    if (figure.nodes[i].joint) {
      EXPECT_LT((rest[i] - skeleton.joints[*figure.nodes[i].joint]).norm(), 1e-6)
          << figure.nodes[i].name;
    }
  }
}

// Angles continue beyond 180 degrees, and no joint rotates more between two frames than the
// walker's.
TEST(Bvh, AnglesDoNotJump) {
  const Made walk = made(40, true);
  const ReadBvh file =
      read_bvh(bvh_from_figure(animated_figure(walk.motion, walk.body.lengths), kRate));
  double widest = 0;
  for (size_t row = 1; row < file.frames.size(); ++row)
    for (size_t k = 6; k < file.frames[row].size(); ++k)
      widest = std::max(widest, std::abs(file.frames[row][k] - file.frames[row - 1][k]));
  EXPECT_LT(widest, 120);
  const double turned = file.frames.back()[5] - file.frames.front()[5];
  EXPECT_GT(turned, 360);
}

// Nobody is shown in frames without a track: glTF hides the figure, BVH repeats a frame.
TEST(AnimatedFigure, GapsAreHiddenOrHeld) {
  Made walk = made(30, false);
  for (const size_t row : {0u, 1u, 12u, 13u, 29u}) walk.motion.joints[row] = unknown_joints();
  walk.motion.joints[20][Joint::kLeftKnee].y() = kUnseen;
  const AnimatedFigure figure = animated_figure(walk.motion, walk.body.lengths);
  EXPECT_FALSE(figure.frames[20].has_value());
  const ReadBvh bvh = read_bvh(bvh_from_figure(figure, kRate));
  EXPECT_EQ(bvh.frames[0], bvh.frames[2]);
  EXPECT_EQ(bvh.frames[12], bvh.frames[11]);
  EXPECT_EQ(bvh.frames[29], bvh.frames[28]);
  EXPECT_NE(bvh.frames[14], bvh.frames[13]);
  const std::string bytes = glb_from_figure(figure, walk.body.subject);
  const ReadGlb glb(bytes);
  const auto size_at = [&](size_t row) {
    return glb.at(static_cast<double>(row) / kRate + 1e-6).nodes.at("rknee").linear().norm();
  };
  for (size_t row = 0; row < 30; ++row) {
    EXPECT_EQ(size_at(row) > 0.5, figure.frames[row].has_value()) << row;
    if (!figure.frames[row]) continue;
    EXPECT_LT(bvh_error(bvh, walk.motion, row), 2e-5) << row;
    EXPECT_LT(glb_error(glb, walk.motion, row), 1e-5) << row;
  }
  Made nobody = made(3, false);
  for (JointPositions& joints : nobody.motion.joints) joints = unknown_joints();
  const AnimatedFigure none = animated_figure(nobody.motion, nobody.body.lengths);
  EXPECT_EQ(bvh_from_figure(none, kRate), "");
  EXPECT_EQ(glb_from_figure(none, {}), "");
  EXPECT_FALSE(animated_figure({}, nobody.body.lengths).any_frame());
}

// Tracked and measured bones change their lengths: glTF contains this, BVH has their means, and its
// knees are adapted so that ankles keep their positions.
TEST(AnimatedFigure, LengthsThatChangeAreMeansInBvhAndKeptInGltf) {
  Made walk = made(30, false);
  for (size_t row = 0; row < 30; ++row) {
    JointPositions& joints = walk.motion.joints[row];
    const Vector3d thigh = joints[Joint::kLeftKnee] - joints[Joint::kLeftHip];
    joints[Joint::kLeftKnee] += (row % 2 == 0 ? 0.01 : -0.01) * thigh.normalized();
    joints[Joint::kRightToe].setConstant(kUnseen);
  }
  const AnimatedFigure figure = animated_figure(walk.motion, walk.body.lengths);
  const ReadBvh bvh = read_bvh(bvh_from_figure(figure, kRate));
  const std::string bytes = glb_from_figure(figure, walk.body.subject);
  const ReadGlb glb(bytes);
  for (size_t row = 0; row < 30; ++row) {
    EXPECT_LT(glb_error(glb, walk.motion, row), 1e-5) << row;
    EXPECT_NEAR((bvh.places(row).at("lknee") - bvh.places(row).at("lhip")).norm(),
                walk.body.lengths.thigh, 1e-5);
    for (const Joint joint : {Joint::kLeftAnkle, Joint::kRightAnkle, Joint::kLeftToe})
      EXPECT_LT(
          (bvh.places(row).at(bvh_name(joint)) - in_file(walk.motion.joints[row][joint])).norm(),
          2e-5)
          << row;
    EXPECT_LT(bvh_error(bvh, walk.motion, row), 0.04) << "the knee";
  }
}

// Joints in a line, or in one place, give finite numbers as well.
TEST(AnimatedFigure, ExtremePosesStayFinite) {
  Made walk = made(6, true);
  auto& joints = walk.motion.joints;
  joints[0][Joint::kNeck] = joints[0][Joint::kPelvis];
  joints[0][Joint::kHead] = joints[0][Joint::kPelvis];
  joints[1][Joint::kNeck] = joints[1][Joint::kLeftHip];  // lies on its side
  joints[2][Joint::kLeftToe] = joints[2][Joint::kLeftAnkle];
  joints[3][Joint::kLeftElbow] = joints[3][Joint::kLeftShoulder];
  joints[4][Joint::kLeftShoulder] = joints[4][Joint::kRightShoulder];
  joints[5][Joint::kLeftKnee] = joints[5][Joint::kLeftHip];  // no leg: no frame
  const AnimatedFigure figure = animated_figure(walk.motion, walk.body.lengths);
  for (size_t row = 0; row < 5; ++row) {
    ASSERT_TRUE(figure.frames[row]) << row;
    for (const auto& turn : figure.frames[row]->turn) EXPECT_NEAR(turn.norm(), 1, 1e-9);
    for (const auto& offset : figure.frames[row]->offset) EXPECT_TRUE(offset.allFinite());
  }
  EXPECT_FALSE(figure.frames[5]);
  read_bvh(bvh_from_figure(figure, kRate));
  const std::string bytes = glb_from_figure(figure, walk.body.subject);
  EXPECT_LT(glb_error(ReadGlb(bytes), walk.motion, 0), 1e-5);
}

// What the specification asks of meshes, skins and animations beyond what the reader checks.
TEST(Gltf, HoldsTheRulesOfTheSpecification) {
  const Made walk = made(10, true);
  const std::string bytes =
      glb_from_figure(animated_figure(walk.motion, walk.body.lengths), walk.body.subject);
  const ReadGlb file(bytes);
  const auto& primitives = file.json.at("meshes").at(0).at("primitives");
  size_t triangles = 0;
  for (const auto& primitive : primitives) {
    const auto& attributes = primitive.at("attributes");
    const auto places = file.numbers(attributes.at("POSITION")),
               normals = file.numbers(attributes.at("NORMAL")),
               weights = file.numbers(attributes.at("WEIGHTS_0")),
               joints = file.numbers(attributes.at("JOINTS_0"));
    const size_t vertices = places.size() / 3;
    EXPECT_TRUE(file.json["accessors"][attributes["POSITION"].get<size_t>()].contains("min"));
    EXPECT_EQ(normals.size(), 3 * vertices);
    EXPECT_EQ(joints.size(), 4 * vertices);
    for (size_t i = 0; i < vertices; ++i) {
      EXPECT_NEAR(std::hypot(normals[3 * i], normals[3 * i + 1], normals[3 * i + 2]), 1, 1e-5);
      EXPECT_EQ(weights[4 * i] + weights[4 * i + 1] + weights[4 * i + 2] + weights[4 * i + 3], 1);
      EXPECT_LT(joints[4 * i], 18);
    }
    const auto indices = file.numbers(primitive.at("indices"));
    EXPECT_EQ(indices.size() % 3, 0u);
    for (size_t i = 0; i < indices.size(); i += 3) {
      const auto corner = [&](size_t k) {
        return Vector3d(places.data() + 3 * static_cast<ptrdiff_t>(indices.at(i + k)));
      };
      const Vector3d outwards(normals.data() + 3 * static_cast<ptrdiff_t>(indices[i]));
      EXPECT_GT((corner(1) - corner(0)).cross(corner(2) - corner(0)).dot(outwards), 0);
      ++triangles;
    }
  }
  EXPECT_GT(triangles, 2000u);
  const auto& skin = file.json.at("skins").at(0);
  const auto matrices = file.numbers(skin.at("inverseBindMatrices"));
  EXPECT_EQ(matrices.size(), 16 * skin.at("joints").size());
  for (size_t i = 0; i < matrices.size(); i += 16)
    EXPECT_THAT(std::vector(matrices.begin() + static_cast<ptrdiff_t>(i) + 12,
                            matrices.begin() + static_cast<ptrdiff_t>(i) + 16)
                    .back(),
                1);
  for (const auto& sampler : file.json.at("animations").at(0).at("samplers")) {
    const auto times = file.numbers(sampler.at("input"));
    EXPECT_TRUE(file.json["accessors"][sampler["input"].get<size_t>()].contains("min"));
    for (size_t i = 1; i < times.size(); ++i) EXPECT_GT(times[i], times[i - 1]);
  }
}

// The skinned surface moves with the figure: in every frame a vertex at the end of the left shank
// is as near to the ankle as the ankle is wide.
TEST(Gltf, TheSurfaceMovesWithItsJoints) {
  const Made walk = made(12, true);
  const std::string bytes =
      glb_from_figure(animated_figure(walk.motion, walk.body.lengths), walk.body.subject);
  const ReadGlb file(bytes);
  const auto& attributes = file.json.at("meshes").at(0).at("primitives").at(0).at("attributes");
  const auto places = file.numbers(attributes.at("POSITION")),
             joints = file.numbers(attributes.at("JOINTS_0")),
             matrices = file.numbers(file.json.at("skins").at(0).at("inverseBindMatrices"));
  const auto shank = [&](size_t i) {
    return file.json["nodes"][static_cast<size_t>(joints[4 * i])].at("name") == "lknee";
  };
  for (const size_t row : {0u, 7u, 11u}) {
    const GlbPose pose = file.at(walk.motion.time[row] + 1e-7);
    double nearest = 1, furthest = 0;
    const Vector3d from = in_file(walk.motion.joints[row][Joint::kLeftAnkle]);
    for (size_t i = 0; i < places.size() / 3; ++i) {
      if (!shank(i)) continue;
      const auto index = static_cast<ptrdiff_t>(joints[4 * i]);
      const Eigen::Affine3d inverse(Eigen::Matrix4d(matrices.data() + 16 * index));
      const Vector3d at = pose.nodes.at("lknee") * inverse *
                          Vector3d(places.data() + 3 * static_cast<ptrdiff_t>(i));
      nearest = std::min(nearest, (at - from).norm());
      furthest = std::max(furthest, (at - from).norm());
    }
    EXPECT_LT(nearest, 0.04);
    EXPECT_NEAR(furthest, walk.body.lengths.shank, 0.08);
  }
}

}  // namespace
}  // namespace walktrack
