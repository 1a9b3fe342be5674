#include "jobs/track/input/person_finder.h"

#include <algorithm>
#include <filesystem>

#include <gtest/gtest.h>

#include "io/archive/files.h"
#include "io/video/video.h"
#include "jobs/track/input/pose_model.h"
#include "observation/observation_config.h"

namespace walktrack {
namespace {

using enum KeypointName;

DetectedPerson standing(float x, float foot_y, float height) {
  DetectedPerson person;
  const auto put = [&](KeypointName name, float dx, float up) {
    person[name] = {x + dx * height, foot_y - up * height, 0.9f};
  };
  put(kLeftShoulder, 0.1f, 0.82f);
  put(kRightShoulder, -0.1f, 0.82f);
  put(kLeftHip, 0.05f, 0.53f);
  put(kRightHip, -0.05f, 0.53f);
  put(kLeftAnkle, 0.05f, 0.04f);
  put(kRightAnkle, -0.05f, 0.04f);
  return person;
}

bool holds(const CutOut& cut_out, float x, float y) {
  const auto x0 = static_cast<float>(cut_out.x0), y0 = static_cast<float>(cut_out.y0);
  const auto side = static_cast<float>(cut_out.side_px);
  return x >= x0 && x < x0 + side && y >= y0 && y < y0 + side;
}

TEST(CutOut, HoldsThePersonWithRoomToSpare) {
  const auto cut_out = cut_out_around(standing(300, 700, 400));
  ASSERT_TRUE(cut_out);
  EXPECT_GT(cut_out->side_px, 1.2 * 400);
  EXPECT_LT(cut_out->side_px, 1.6 * 400);
  EXPECT_TRUE(holds(*cut_out, 300, 700));
  EXPECT_TRUE(holds(*cut_out, 300, 300));
}

TEST(CutOut, IsNotMadeOfHalfAPerson) {
  DetectedPerson person = standing(300, 700, 400);
  person[kLeftHip].confidence = person[kRightHip].confidence = 0.1f;
  EXPECT_FALSE(cut_out_around(person));
  EXPECT_FALSE(cut_out_around(DetectedPerson()));
}

// The region is that of the shrunk image.
TEST(CutOut, IsAroundTheRegion) {
  const Region region{{40, 20, 80, 120}, 0.02, false};
  const CutOut cut_out = cut_out_around(region, 3, 1.6);
  EXPECT_EQ(cut_out.side_px, static_cast<int>(std::lround(kCutOutMargin * 80 * 3)));
  EXPECT_NEAR(cut_out.x0 + cut_out.side_px / 2.0, 180, 1);
  EXPECT_NEAR(cut_out.y0 + cut_out.side_px / 2.0, 210, 1);
}

TEST(CutOut, IsAroundTheSubjectsPartOfARegion) {
  const Region narrow{{40, 20, 80, 120}, 0.02, false};
  Region wide = narrow;
  wide.area = {0, 10, 200, 150};
  wide.subject = narrow.area;
  const CutOut expected = cut_out_around(narrow, 3, 1.6), found = cut_out_around(wide, 3, 1.6);
  EXPECT_EQ(found.x0, expected.x0);
  EXPECT_EQ(found.y0, expected.y0);
  EXPECT_EQ(found.side_px, expected.side_px);
}

// Wherever a person is, one of the squares contains all of them at a sufficient size.
TEST(Squares, HoldAPersonAnywhere) {
  const double height = 130;
  const auto squares = squares_over(640, 480, height);
  for (float x = 0; x < 640; x += 20) {
    for (float y = 0; y < 480 - static_cast<float>(height); y += 20) {
      const bool held = std::any_of(squares.begin() + 1, squares.end(), [&](const CutOut& square) {
        return holds(square, x, y) && holds(square, x, y + static_cast<float>(height)) &&
               square.side_px < 3 * height;
      });
      EXPECT_TRUE(held) << x << " " << y;
    }
  }
}

// The whole image is asked for until somebody is followed, and then only in every third frame.
TEST(PersonFinder, LooksForOthersNowAndThen) {
  const auto model = pose_model_file(KeypointConfig().model);
  if (!has_pose_net() || !model) GTEST_SKIP() << "without a pose detector";
  PoseNet net(read_text_file(*model, kMaxModelBytes), model->string());
  FrameSource video(std::filesystem::path(WALKTRACK_SOURCE_DIR) / "data/demo/side.mp4");
  PersonFinder finder(video.facts().width_px, video.facts().height_px, 400, 3);
  constexpr int kLooks = 12, kFramesBefore = 30;  // the subject is inside of the picture
  size_t asked = 0, wholes = 0, found = 0;
  Image picture;
  for (int n = 0; n < kFramesBefore + kLooks && video.read(picture); ++n) {
    if (n < kFramesBefore) continue;
    const PartOfFrame part_of_frame = [&](const CutOut& where) {
      ++asked;
      wholes += where.side_px >= video.facts().width_px;
      return ImagePart{picture};
    };
    found += finder.look(net, part_of_frame, n - kFramesBefore).size();
  }
  EXPECT_EQ(found, size_t{kLooks});
  EXPECT_EQ(wholes, size_t{kLooks} / 3);
  EXPECT_EQ(asked, 1 + wholes + kLooks - 1);  // once more after the first sight
}

TEST(Squares, AreOneForALargePerson) { EXPECT_EQ(squares_over(640, 480, 400).size(), 1u); }

}  // namespace
}  // namespace walktrack
