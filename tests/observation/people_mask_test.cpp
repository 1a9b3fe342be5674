#include "observation/background/people_mask.h"

#include <tuple>

#include <gtest/gtest.h>
#include <opencv2/core.hpp>

#include "observation/keypoints/keypoints.h"

namespace walktrack {
namespace {

using enum KeypointName;

// Stands upright, `height` px from the eyes to the ankles.
DetectedPerson standing(float x, float top, float height) {
  DetectedPerson person;
  const auto set = [&](KeypointName name, float across, float down) {
    person[name] = {x + across * height, top + down * height, 0.9F};
  };
  set(kNose, 0, 0.02F);
  set(kLeftEye, 0.02F, 0);
  set(kRightEye, -0.02F, 0);
  for (const auto& [left, right, across, down] :
       {std::tuple{kLeftShoulder, kRightShoulder, 0.12F, 0.13F},
        {kLeftHip, kRightHip, 0.06F, 0.46F},
        {kLeftKnee, kRightKnee, 0.06F, 0.73F},
        {kLeftAnkle, kRightAnkle, 0.06F, 1.F}}) {
    set(left, across, down);
    set(right, -across, down);
  }
  return person;
}

TEST(PeopleMask, CoversPeopleFromHairToToesAndNothingFarFromThem) {
  const DetectedPerson left = standing(60, 40, 100), right = standing(160, 60, 60);
  const cv::Mat mask = people_mask({left, right}, {240, 180});
  ASSERT_EQ(mask.size(), cv::Size(240, 180));
  for (const DetectedPerson& person : {left, right}) {
    for (const Keypoint& point : person.points) {
      if (point.confidence == 0) continue;
      const cv::Point at(static_cast<int>(point.x_px), static_cast<int>(point.y_px));
      EXPECT_EQ(mask.at<uint8_t>(at), 255) << at;
    }
  }
  EXPECT_EQ(mask.at<uint8_t>(30, 60), 255) << "hair";
  EXPECT_EQ(mask.at<uint8_t>(150, 66), 255) << "toes";
  EXPECT_EQ(mask.at<uint8_t>(70, 160), 255) << "the second person";
  EXPECT_EQ(mask.at<uint8_t>(90, 110), 0) << "between them";
  EXPECT_EQ(mask.at<uint8_t>(175, 60), 0) << "the floor before them";
  EXPECT_EQ(mask.at<uint8_t>(10, 60), 0) << "above them";
  EXPECT_LT(cv::countNonZero(mask), 100 * 130 * 0.5 + 60 * 80 * 0.5);
}

TEST(PeopleMask, OfNobodyIsEmpty) {
  EXPECT_EQ(cv::countNonZero(people_mask({}, {64, 48})), 0);
  DetectedPerson doubtful = standing(30, 5, 30);
  for (Keypoint& point : doubtful.points) point.confidence = 0.05F;
  EXPECT_EQ(cv::countNonZero(people_mask({doubtful}, {64, 48})), 0);
}

TEST(PeopleMask, OfSomebodyWhoIsPartlyOutsideIsInsideThePicture) {
  const cv::Mat mask = people_mask({standing(2, 10, 100)}, {64, 48});
  EXPECT_GT(cv::countNonZero(mask), 0);
  EXPECT_EQ(people_mask({standing(1e6F, 1e6F, 100)}, {64, 48}).size(), cv::Size(64, 48));
}

}  // namespace
}  // namespace walktrack
