#include "observation/pose_net/pose_maps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <vector>

namespace walktrack {
namespace {

constexpr int kSide = 48;
constexpr size_t kCells = size_t{kSide} * kSide;

size_t cell(int x, int y) { return static_cast<size_t>(y * kSide + x); }

// Empty maps, in which tests set values.
struct HandMade {
  std::vector<float> centre = std::vector<float>(kCells, -9);
  std::vector<float> heat = std::vector<float>(kCocoPoints * kCells, -9);
  std::vector<float> regress = std::vector<float>(2 * kCocoPoints * kCells, 0);
  std::vector<float> offset = std::vector<float>(2 * kCocoPoints * kCells, 0);

  void person(int x, int y, float strength) { centre[cell(x, y)] = strength; }
  // Sets the expected position of point k of a person whose middle is at (x, y).
  void expect(size_t k, int x, int y, float dx, float dy) {
    regress[2 * k * kCells + cell(x, y)] = dy;
    regress[(2 * k + 1) * kCells + cell(x, y)] = dx;
  }
  void point(size_t k, int x, int y, float strength, float dx, float dy) {
    heat[k * kCells + cell(x, y)] = strength;
    offset[2 * k * kCells + cell(x, y)] = dy;
    offset[(2 * k + 1) * kCells + cell(x, y)] = dx;
  }
  DetectedPerson read(const CutOut& cut_out) const {
    return decoded({kSide, centre, heat, regress, offset}, cut_out);
  }
};

constexpr CutOut kWhole{0, 0, 192};  // a cell is 4 px

TEST(PoseMaps, PlaceIsTheCellPlusItsOffset) {
  HandMade maps;
  maps.person(20, 30, 4);
  maps.expect(13, 20, 30, -5, 8);
  maps.point(13, 15, 38, 2, 0.25f, 0.75f);
  const Keypoint knee = maps.read(kWhole)[KeypointName::kLeftKnee];
  EXPECT_FLOAT_EQ(knee.x_px, 4 * 15.25f - 0.5f);
  EXPECT_FLOAT_EQ(knee.y_px, 4 * 38.75f - 0.5f);
  EXPECT_FLOAT_EQ(knee.confidence, 1 / (1 + std::exp(-2.f)));
}

// A cut-out is shifted and scaled back to the image.
TEST(PoseMaps, ArePlacedInThePicture) {
  HandMade maps;
  maps.person(24, 24, 4);
  maps.expect(0, 24, 24, 0, -12);
  maps.point(0, 24, 12, 3, 0, 0.5f);
  const Keypoint nose = maps.read({-100, 50, 480})[KeypointName::kNose];
  EXPECT_FLOAT_EQ(nose.x_px, -100 - 0.5f + 240);
  EXPECT_FLOAT_EQ(nose.y_px, 50 - 0.5f + 125);
}

// Of two people the one nearer to the middle is chosen, of two knees that of the person.
TEST(PoseMaps, AnswerForThePersonInTheMiddle) {
  HandMade maps;
  maps.person(23, 24, 2);
  maps.person(2, 24, 3);  // more confident, but far away
  maps.expect(14, 23, 24, 0, 6);
  maps.expect(14, 2, 24, 0, 6);
  maps.point(14, 23, 31, 1, 0, 0);
  maps.point(14, 2, 30, 3, 0, 0);
  EXPECT_FLOAT_EQ(maps.read(kWhole)[KeypointName::kRightKnee].x_px, 4 * 23 - 0.5f);
}

TEST(PoseMaps, OfNobodyHaveLowConfidences) {
  for (const Keypoint& point : HandMade().read(kWhole).points) EXPECT_LT(point.confidence, 0.001);
}

// The network has no points of feet.
TEST(PoseMaps, LeaveTheFeetOut) {
  HandMade maps;
  maps.person(24, 24, 4);
  const DetectedPerson person = maps.read(kWhole);
  for (size_t k = kCocoPoints; k < kKeypointCount; ++k)
    EXPECT_EQ(person.points[k].confidence, 0) << kKeypointNames[k];
}

}  // namespace
}  // namespace walktrack
