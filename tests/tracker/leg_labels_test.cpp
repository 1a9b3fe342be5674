#include "tracker/smooth/leg_labels.h"

#include <cmath>

#include <gtest/gtest.h>
#include "tests/tracker/frame_time.h"

namespace walktrack {
namespace {

std::vector<NamedFrame> track(size_t frames, double odds) {
  return std::vector<NamedFrame>(frames, NamedFrame{true, odds, 0.1});
}

TEST(LegLabels, SayWhatTheTrackSaidWhereFramesSayNothing) {
  for (const double p : swapped_probabilities(track(2, 0), kDt)) EXPECT_NEAR(p, 0.1, 1e-3);
}

TEST(LegLabels, AddUpOverTheTrack) {
  const auto right = swapped_probabilities(track(60, 0.3), kDt);
  const auto wrong = swapped_probabilities(track(60, -0.3), kDt);
  for (size_t i = 0; i < 60; ++i) {
    EXPECT_LT(right[i], 0.02);
    EXPECT_GT(wrong[i], 0.98);
  }
}

TEST(LegLabels, FindWhereALegWasTakenForTheOther) {
  std::vector<NamedFrame> frames = track(60, 1);
  for (size_t i = 25; i < 60; ++i) frames[i].odds = -1;
  const auto swapped = swapped_probabilities(frames, kDt);
  for (size_t i = 0; i < 60; ++i) EXPECT_EQ(swapped[i] > 0.5, i >= 25) << i;
}

TEST(LegLabels, OneFrameAloneSwapsNothing) {
  std::vector<NamedFrame> frames = track(60, 1);
  frames[30].odds = -3;
  for (const double p : swapped_probabilities(frames, kDt)) EXPECT_LT(p, 0.1);
}

// The same as summing over all 2^n paths.
TEST(LegLabels, AreTheChainsOwnMarginals) {
  std::vector<NamedFrame> frames = track(8, 0);
  for (size_t i = 0; i < 8; ++i) frames[i].odds = std::sin(3.0 * double(i));
  const double change = kSwapsPerSecond * 5;  // dt of 5 s
  std::vector<double> swapped(8), total(1);
  for (unsigned path = 0; path < 256; ++path) {
    double p = (path & 1) ? 0.1 : 0.9;
    for (unsigned i = 0; i < 8; ++i) {
      if ((path >> i) & 1) p *= std::exp(-frames[i].odds);
      if (i > 0) p *= ((path >> i) & 1) == ((path >> (i - 1)) & 1) ? 1 - change : change;
    }
    total[0] += p;
    for (unsigned i = 0; i < 8; ++i)
      if ((path >> i) & 1) swapped[i] += p;
  }
  const auto found = swapped_probabilities(frames, 5);
  for (size_t i = 0; i < 8; ++i) EXPECT_NEAR(found[i], swapped[i] / total[0], 1e-12);
}

// Clear frames determine the labels within a second; after as long without any they are uncertain
// again.
TEST(NamesSoFar, AreInDoubtUntilFramesHaveSaidEnough) {
  NamesSoFar names;
  EXPECT_TRUE(names.in_doubt());
  names.add({true, 0.5, 0.1}, kDt);
  EXPECT_TRUE(names.in_doubt());
  for (int i = 0; i < 30; ++i) names.add({true, 0.5, 0.1}, kDt);
  EXPECT_FALSE(names.in_doubt());
  int unasked = 0;
  for (; !names.in_doubt(); ++unasked) names.add({true, 0, 0.1}, kDt);
  EXPECT_GT(unasked, 10);
  EXPECT_LT(unasked, 60);
  names.add({}, kDt);
  EXPECT_TRUE(names.in_doubt()) << "after a loss";
}

// The last frame's labels are the same forward and backward.
TEST(NamesSoFar, AgreeWithTheWholeTrackAtItsEnd) {
  for (const double odds : {0.08, 0.25}) {
    NamesSoFar names;
    for (const NamedFrame& frame : track(20, odds)) names.add(frame, kDt);
    const double swapped = swapped_probabilities(track(20, odds), kDt).back();
    EXPECT_EQ(names.in_doubt(), swapped > 0.02) << odds;
  }
}

TEST(LegLabels, TracksDoNotHearEachOther) {
  std::vector<NamedFrame> frames = track(21, 1);
  frames[10] = {};
  for (size_t i = 11; i < 21; ++i) frames[i].odds = -1;
  const auto swapped = swapped_probabilities(frames, kDt);
  EXPECT_LT(swapped[9], 0.01);
  EXPECT_EQ(swapped[10], 0);
  EXPECT_GT(swapped[11], 0.99);
}

}  // namespace
}  // namespace walktrack
