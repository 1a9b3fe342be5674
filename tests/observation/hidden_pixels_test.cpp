#include "observation/silhouette/hidden_pixels.h"

#include <vector>

#include <gtest/gtest.h>

#include "observation/silhouette/silhouette.h"

namespace walktrack {
namespace {

constexpr PixelRect kArea{5, 0, 130, 140};
constexpr double kScale = 0.02;  // m in a pixel
constexpr int kWayPx = 3;        // of the subject between two frames
constexpr int kFirst = 32;       // column of the subject in the first frame

CapsuleList subject_at(double x) {
  CapsuleList out;
  out.insert({{{x, 100}, 9}, {{x, 50}, 9}, 4, Appearance::kTrunk, 0});
  return out;
}

// Something in front of the subject in some columns, and until some frame.
struct Thing {
  int from, to;
  size_t until = 100;
  bool covers(size_t frame, int x) const { return frame < until && from <= x && x < to; }
};

// A subject who walks to the right, with the figures that are right.
class Comer {
 public:
  Comer(size_t frames, const Thing& thing, float nats = 2, int way_px = kWayPx) : planes_(frames) {
    for (size_t t = 0; t < frames; ++t) {
      const CapsuleList subject = subject_at(kFirst + way_px * static_cast<int>(t));
      resize(planes_[t], kArea, 1);
      for (int y = kArea.y0; y < kArea.y1; ++y) {
        std::vector<float> row(static_cast<size_t>(kArea.width()), -2);
        for (int x = kArea.x0; x < kArea.x1; ++x)
          if (inside(subject[0], {x, y}) && !thing.covers(t, x))
            row[static_cast<size_t>(x - kArea.x0)] = nats;
        set_row(planes_[t], 0, y, row, 4);
      }
      frames_.push_back({&planes_[t], {subject}});
    }
  }
  PixelMask mask(size_t half_hidden) const {
    const std::span<const CoveredFrame> all = frames_;
    return hidden_pixels(all.first(half_hidden), all.subspan(half_hidden), kScale);
  }
  const CoveredFrame& frame(size_t t) const { return frames_[t]; }
  LogRatioPlanes& planes(size_t t) { return planes_[t]; }

 private:
  std::vector<LogRatioPlanes> planes_;
  std::vector<CoveredFrame> frames_;
};

constexpr Thing kTree{0, 40}, kNothing{0, 0};

bool at(const PixelMask& mask, int x, int y) {
  const auto width = static_cast<size_t>(mask.area.width());
  return mask.set[static_cast<size_t>(y - mask.area.y0) * width +
                  static_cast<size_t>(x - mask.area.x0)] != 0;
}

TEST(HiddenPixels, AreThoseOfTheThingInFrontOfTheSubject) {
  const Comer comer(16, kTree);
  const PixelMask mask = comer.mask(4);
  ASSERT_FALSE(mask.set.empty());
  for (int y = 55; y < 95; ++y) {
    for (int x = 28; x < 37; ++x) EXPECT_TRUE(at(mask, x, y)) << x << ", " << y;
    for (int x = 43; x < 80; ++x) EXPECT_FALSE(at(mask, x, y)) << x << ", " << y;
  }
  EXPECT_TRUE(at(mask, 20, 75)) << "within 40 cm, where nobody was";
  EXPECT_FALSE(at(mask, 11, 10)) << "further away";
}

LogRatioPlanes part_of(const LogRatioPlanes& planes, const PixelRect& area) {
  LogRatioPlanes part;
  resize(part, area, 1);
  for (int y = area.y0; y < area.y1; ++y) {
    std::vector<float> row;
    for (int x = area.x0; x < area.x1; ++x)
      row.push_back(static_cast<float>(log_ratio_at(planes, Appearance::kTrunk, x, y)));
    set_row(part, 0, y, row, 4);
  }
  return part;
}

// After a track is lost, frames of which only the surroundings of the subject were compared are
// searched together with whole ones.
TEST(HiddenPixels, FramesMayHaveDifferentAreas) {
  Comer comer(16, kTree);
  const PixelMask whole = comer.mask(4);
  constexpr PixelRect kPart{9, 20, 100, 130};
  for (const size_t t : {0u, 3u, 7u}) comer.planes(t) = part_of(comer.planes(t), kPart);
  PixelMask mask = comer.mask(4);
  EXPECT_EQ(mask.area.x0, kArea.x0);
  EXPECT_EQ(mask.area.y1, kArea.y1);
  EXPECT_EQ(mask.set, whole.set);
  LogRatioPlanes planes = comer.planes(7), full = *Comer(16, kTree).frame(7).planes;
  hide(mask, planes);
  hide(mask, full);
  for (int y = kPart.y0; y < kPart.y1; ++y)
    for (int x = kPart.x0; x < kPart.x1; ++x)
      EXPECT_EQ(log_ratio_at(planes, Appearance::kTrunk, x, y),
                log_ratio_at(full, Appearance::kTrunk, x, y));
}

TEST(HiddenPixels, AreNoneIfTheSubjectIsWhole) {
  EXPECT_TRUE(Comer(16, kNothing).mask(4).set.empty());
}

TEST(HiddenPixels, AreNoneWhereOneFrameShowsTheSubject) {
  Comer comer(16, kTree);
  const Comer visible(16, kNothing);
  const PixelMask before = comer.mask(4);
  comer.planes(2) = *visible.frame(2).planes;
  const PixelMask mask = comer.mask(4);
  EXPECT_TRUE(at(before, 35, 75));
  EXPECT_TRUE(mask.set.empty() || !at(mask, 35, 75));
}

// No frame alone looks like a foreground, but all of them together say more than two that show
// nobody.
TEST(HiddenPixels, AreNoneWhereManyFramesShowTheSubjectFaintly) {
  EXPECT_TRUE(Comer(16, {0, 40, 2}, 0.8F, 0).mask(2).set.empty());
}

TEST(HiddenPixels, AreNoneOfThingsSmallerThanAHand) {
  EXPECT_TRUE(Comer(16, {30, 32}).mask(4).set.empty());
}

TEST(HiddenPixels, FramesWithoutAnImageDoNotCount) {
  Comer comer(16, kTree);
  const PixelMask before = comer.mask(4);
  comer.planes(0) = {};
  comer.planes(9) = {};
  const PixelMask mask = comer.mask(4);
  EXPECT_TRUE(at(mask, 33, 75));
  EXPECT_EQ(mask.area.width(), before.area.width());
}

TEST(HiddenShare, IsThatOfTheFigureBehindTheThing) {
  const Comer comer(16, {0, kFirst});
  EXPECT_NEAR(hidden_share(comer.frame(0)), 0.5, 0.05);
  EXPECT_EQ(hidden_share(comer.frame(15)), 0);
  EXPECT_EQ(hidden_share({comer.frame(0).planes, {}}), 0);
}

TEST(HiddenPixels, AreNoEvidenceAfterwards) {
  Comer comer(16, kTree);
  const LogRatioPlanes before = *comer.frame(1).planes;
  LogRatioPlanes after = before;
  const PixelMask mask = comer.mask(4);
  hide(mask, after);
  for (int y = kArea.y0; y < kArea.y1; ++y)
    for (int x = kArea.x0; x < kArea.x1; ++x)
      ASSERT_EQ(log_ratio_at(after, Appearance::kTrunk, x, y),
                at(mask, x, y) ? 0 : log_ratio_at(before, Appearance::kTrunk, x, y));
  EXPECT_GT(silhouette_log_ratio(after, subject_at(kFirst + kWayPx)),
            silhouette_log_ratio(before, subject_at(kFirst + kWayPx)) + 100);
}

}  // namespace
}  // namespace walktrack
