#include "observation/background/moved_things.h"

#include <algorithm>
#include <array>
#include <functional>

#include <gtest/gtest.h>
#include <opencv2/imgproc.hpp>

#include "core/rng.h"

namespace walktrack {
namespace {

constexpr int kAcross = 120, kDown = 90, kFrames = 8;
constexpr double kLeastSide = 6;  // px
const cv::Rect kThing(70, 40, 20, 24);
const cv::Scalar kThingColour(60, 70, 150), kClothes(150, 60, 40);

class MovedThingsTest : public testing::Test {
 protected:
  cv::Mat room(double gain = 1) {
    cv::Mat out(kDown, kAcross, CV_8UC3);
    for (int y = 0; y < kDown; ++y)
      for (int x = 0; x < kAcross; ++x)
        for (int c = 0; c < 3; ++c)
          out.at<cv::Vec3b>(y, x)[c] = cv::saturate_cast<uint8_t>(
              gain * (100 + 20 * c + 0.3 * x + 0.2 * y) + 2 * rng_.normal());
    return out;
  }
  BackgroundModel model(const cv::Mat& picture) const {
    BackgroundSampler sampler(config_);
    sampler.add(picture);
    return sampler.model();
  }
  // The empty scene corrected by frames of the room, each with what `add` draws into it.
  BackgroundModel corrected(const BackgroundModel& empty_scene,
                            const std::function<void(int frame, cv::Mat&)>& add,
                            int frames = kFrames, double gain = 1, int threads = 1) {
    MovedThings things(config_, empty_scene, kLeastSide, threads);
    for (int f = 0; f < frames; ++f) {
      cv::Mat frame = room(gain);
      add(f, frame);
      things.compare(frame);
    }
    return things.corrected();
  }
  static void nothing(int, cv::Mat&) {}
  // Somebody who is elsewhere in every frame.
  static void passer_by(int frame, cv::Mat& picture) {
    picture(cv::Rect(5 + 12 * frame, 30, 10, 40)) = kClothes;
  }
  BackgroundModel room_with_thing() {
    cv::Mat picture = room();
    picture(kThing) = kThingColour;
    return model(picture);
  }
  static double share(const cv::Rect& area) {
    return area.area() / static_cast<double>(kAcross * kDown);
  }
  // Luma of the model in the middle of the thing.
  static double luma_there(const BackgroundModel& model) {
    const cv::Point middle = (kThing.tl() + kThing.br()) / 2;
    return model.luma[static_cast<size_t>(middle.y * kAcross + middle.x)];
  }
  BackgroundConfig config_;
  Rng rng_{1, Purpose::kTest};
};

TEST_F(MovedThingsTest, AnEmptySceneThatFitsIsKept) {
  const BackgroundModel empty = model(room());
  for (const auto& add : {nothing, passer_by}) {
    const BackgroundModel out = corrected(empty, add);
    EXPECT_EQ(out.from_video, 0);
    EXPECT_EQ(out.luma, empty.luma);
  }
}

TEST_F(MovedThingsTest, WhatOnlyTheEmptySceneShowsIsTheVideos) {
  const BackgroundModel empty = room_with_thing();
  const BackgroundModel clean = model(room());
  ASSERT_GT(std::abs(luma_there(empty) - luma_there(clean)), 30);
  for (const double gain : {1.0, 0.7}) {
    const BackgroundModel out = corrected(empty, passer_by, kFrames, gain);
    EXPECT_GT(out.from_video, share(kThing)) << gain;  // with its edges
    EXPECT_LT(out.from_video, 1.6 * share(kThing)) << gain;
    EXPECT_NEAR(luma_there(out), luma_there(clean), 4) << gain;
    EXPECT_EQ(out.luma[0], empty.luma[0]) << gain;
  }
}

TEST_F(MovedThingsTest, WhatOnlyTheVideoShowsIsTheVideos) {
  const BackgroundModel empty = model(room());
  const BackgroundModel out = corrected(empty, [](int frame, cv::Mat& picture) {
    picture(kThing) = kThingColour;
    passer_by(frame, picture);
  });
  EXPECT_GT(out.from_video, share(kThing));
  EXPECT_NEAR(luma_there(out), luma_there(room_with_thing()), 3);
}

// In one frame somebody stands before it, in clothes of its colour.
TEST_F(MovedThingsTest, AThingMayBeHiddenForAWhile) {
  const BackgroundModel out = corrected(room_with_thing(), [](int frame, cv::Mat& picture) {
    if (frame == 3) picture(cv::Rect(kThing.x - 4, kThing.y + 6, 20, 30)) = kThingColour;
  });
  EXPECT_GT(out.from_video, share(kThing));
  EXPECT_LT(out.from_video, 1.6 * share(kThing));
}

// People are not taken for things: who leaves in the end, and who hardly moves, because arms and
// legs go on beyond the pixels that they cover all the time.
TEST_F(MovedThingsTest, PeopleAreNot) {
  const BackgroundModel empty = model(room());
  const auto stands_at_first = [](int frame, cv::Mat& picture) {
    if (frame < kFrames - 1) picture(kThing) = kClothes;
  };
  EXPECT_EQ(corrected(empty, stands_at_first).from_video, 0);
  const auto comes_nearer = [](int frame, cv::Mat& picture) {
    const int half = 4 + frame;
    picture(cv::Rect(60 - half, 20, 2 * half, 30 + 4 * frame)) = kClothes;
  };
  EXPECT_EQ(corrected(empty, comes_nearer).from_video, 0);
  const auto far_away = [](int frame, cv::Mat& picture) {
    const bool left = frame % 2 == 0;  // the arm and the leg in front
    picture(cv::Rect(60, 20, 16, 30)) = kClothes;
    picture(cv::Rect(left ? 76 : 56, 24, 4, 20)) = kClothes;
    picture(cv::Rect(left ? 58 : 70, 50, 8, 20)) = kClothes;
  };
  EXPECT_EQ(corrected(empty, far_away).from_video, 0);
}

TEST_F(MovedThingsTest, FewFramesAndSmallThingsSayNothing) {
  EXPECT_EQ(corrected(room_with_thing(), nothing, 3).from_video, 0);
  EXPECT_GT(corrected(room_with_thing(), nothing, 4).from_video, 0);
  cv::Mat picture = room();
  picture(cv::Rect(50, 50, 5, 5)) = kThingColour;
  EXPECT_EQ(corrected(model(picture), nothing).from_video, 0);
}

TEST_F(MovedThingsTest, MayEndAsSoonAsEverythingWasSeen) {
  const BackgroundModel empty = model(room());
  MovedThings things(config_, empty, kLeastSide, 1);
  EXPECT_TRUE(things.possible());
  for (const int frame : {0, 1}) {
    cv::Mat picture = room();
    passer_by(frame, picture);
    things.compare(picture);
    EXPECT_EQ(things.possible(), frame == 0);
  }
}

TEST_F(MovedThingsTest, ThreadsDoNotMatter) {
  const BackgroundModel empty = room_with_thing();
  std::array<BackgroundModel, 2> out;
  for (const int threads : {1, 3}) {
    rng_ = Rng(2, Purpose::kTest);
    out[threads == 1 ? 0 : 1] = corrected(empty, passer_by, kFrames, 1, threads);
  }
  EXPECT_EQ(out[0].luma, out[1].luma);
  EXPECT_EQ(out[0].from_video, out[1].from_video);
}

}  // namespace
}  // namespace walktrack
