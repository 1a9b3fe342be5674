#include "jobs/track/results/reported_track.h"

#include <cmath>

#include <gtest/gtest.h>

#include "body/kinematics.h"
#include "metrics/plausibility.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

// A person who marches along x: the legs swing half a stride apart, with noise on the whole figure.
struct March {
  BodyModel model;
  double rate = 30, stride = 1.1, speed = 1.2, tremble = 0.015;

  Pose pose(size_t frame) const {
    const double t = static_cast<double>(frame) / rate;
    Pose out;
    out.root = {speed * t, tremble * std::sin(0.7 * static_cast<double>(frame)),
                leg_length(model.body.lengths) - 0.03};
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const double phase = 2 * kPi * (t / stride + (side == Side::kLeft ? 0 : 0.5));
      LegPose& leg = out.legs[static_cast<size_t>(side)];
      leg.hip_flexion = 0.35 * std::cos(phase);
      leg.knee_flexion = 0.1 + 0.5 * std::max(0.0, -std::sin(phase));
      leg.ankle_dorsiflexion = leg.knee_flexion - leg.hip_flexion;  // the sole is level
    }
    return out;
  }

  FrameRecord record(size_t frame) const {
    const FreeNumbers free = free_numbers(model);
    FrameRecord out;
    out.tracked = true;
    out.estimate.joint_count = kJointCountWithoutArms;
    out.estimate.pose = pose(frame);
    out.estimate.joints = forward_kinematics(model.body, out.estimate.pose).joints;
    const Eigen::VectorXd sd = 0.5 * spreads_of(free);
    out.images = {out.estimate.pose, out.estimate.pose,
                  packed(free, sd.cwiseAbs2().cwiseInverse().asDiagonal())};
    return out;
  }
};

March march() {
  March out;
  out.model.body = make_body(Subject{}, {.head = true, .arms = false});
  return out;
}

TrackedFrames frames_of(const March& march, size_t count, const std::filesystem::path& file,
                        size_t untracked = 1) {
  TrackedFrames out{march.rate, FrameFile(file)};
  for (size_t i = 0; i < count; ++i)
    out.records.append(i < untracked ? FrameRecord{} : march.record(i));
  return out;
}

double worst_slide(const TrackedFrames& frames) {
  const Motion motion = motion_of(frames);
  return plausibility(motion, gait_from_motion(motion)).worst_foot_slide;
}

TEST(ReportedTrack, FeetStandStillAndNothingIsLeftBehind) {
  const TemporaryFolder folder;
  const March walk = march();
  const TrackedFrames frames = frames_of(walk, 120, folder / "frames.bin");
  const TrackedFrames moving = seen_together(frames, walk.model, {}, folder / "moving.bin");
  const std::vector<FlatFoot> flat = standing_feet(moving);
  EXPECT_GE(flat.size(), 5u);
  const TrackedFrames still =
      seen_together(frames, walk.model, {.flat = flat}, folder / "still.bin");
  EXPECT_FALSE(std::filesystem::exists(folder / "moving.bin"));
  EXPECT_FALSE(std::filesystem::exists(folder / "still.bin"));
  ASSERT_EQ(still.records.size(), frames.records.size());
  EXPECT_FALSE(still.records[0].tracked);
  EXPECT_GT(worst_slide(moving), 0.03);
  EXPECT_LT(worst_slide(still), 0.3 * worst_slide(moving));
  EXPECT_NEAR(still.records[60].estimate.speed, walk.speed, 0.1);
}

// Memory does not grow with the video: a long track is computed in pieces, without an effect on the
// result.
TEST(ReportedTrack, PiecesOfALongTrackAreThoseOfTheWhole) {
  const TemporaryFolder folder;
  const March walk = march();
  constexpr size_t kFrames = 1300;
  const TrackedFrames frames = frames_of(walk, kFrames, folder / "frames.bin");
  const TrackedFrames pieces = seen_together(frames, walk.model, {}, folder / "pieces.bin");
  std::vector<FrameRecord> records;
  for (const FrameRecord& record : frames.records)
    if (record.tracked) records.push_back(record);
  std::vector<Eigen::Vector2d> places;
  for (const FrameRecord& record : records)
    places.emplace_back(record.estimate.pose.root.head<2>());
  const double dt = 1 / walk.rate;
  const std::vector<WalkingDirection> ways = walking_directions(places, dt);
  const Poses whole = most_probable_trajectory(walk.model, {dt, records, {}, 0, ways}).poses;
  ASSERT_EQ(pieces.records.size(), kFrames);
  const FreeNumbers free = free_numbers(walk.model);
  for (size_t i = 1; i < kFrames; i += 7)
    EXPECT_LT(difference(free, whole[i - 1], pieces.records[i].estimate.pose).norm(), 1e-4) << i;
}

// The same for its samples: they go on where the piece before has left them, and bands are as wide
// after the seam as before it.
TEST(ReportedTrack, SamplesAndBandsRunThroughThePieces) {
  const TemporaryFolder folder;
  const March walk = march();
  TrackedFrames frames{walk.rate, FrameFile(folder / "frames.bin")};
  constexpr size_t kFrames = 700, kSeam = 512;
  for (size_t i = 0; i < kFrames; ++i) {
    FrameRecord record = walk.record(i);
    record.samples.resize(4);
    frames.records.append(record);
  }
  const BandScene bands{{}, 0, 1};
  const TrackedFrames out =
      seen_together(frames, walk.model, {.bands = &bands}, folder / "out.bin");
  const auto step = [&](size_t frame, size_t sample) {
    const FrameRecord before = out.records[frame - 1], now = out.records[frame];
    const auto off = [&](const FrameRecord& record) -> Eigen::Vector3d {
      return record.samples[sample][Joint::kPelvis] - record.estimate.joints[Joint::kPelvis];
    };
    return (off(now) - off(before)).norm();
  };
  for (size_t sample = 0; sample < 4; ++sample) {
    double usual = 0;
    for (size_t frame = 400; frame < 500; ++frame) usual = std::max(usual, step(frame, sample));
    EXPECT_GT(usual, 0);
    EXPECT_LT(step(kSeam, sample), 2 * usual);
  }
  const auto sd = [&](size_t frame) { return out.records[frame].estimate.spread[0][0].sd; };
  EXPECT_NEAR(sd(kSeam) / sd(kSeam - 60), 1, 0.2);
}

// What is known of walks (tracker/walk_prior.h) counts, unless feet are to be judged as the
// images have them.
TEST(ReportedTrack, SwayingToTheSideIsBelievedOnlyByTheImages) {
  const TemporaryFolder folder;
  March walk = march();
  walk.tremble = 0;
  TrackedFrames frames{walk.rate, FrameFile(folder / "frames.bin")};
  for (size_t i = 0; i < 90; ++i) {
    FrameRecord record = walk.record(i);
    record.images.pose.root.y() = 0.1 * std::sin(2 * kPi * static_cast<double>(i) / walk.rate);
    record.images.walker = record.estimate.pose = record.images.pose;
    for (double& each : record.images.information) each /= 4;  // they show it weakly
    frames.records.append(record);
  }
  const auto swaying = [&](bool walk_prior) {
    const TrackedFrames out =
        seen_together(frames, walk.model, {.walk_prior = walk_prior}, folder / "out.bin");
    double most = 0;  // in the second of its three seconds
    for (size_t i = 30; i < 60; ++i)
      most = std::max(most, std::abs(out.records[i].estimate.pose.root.y()));
    return most;
  };
  EXPECT_GT(swaying(false), 0.08);
  EXPECT_LT(swaying(true), 0.05);
}

TEST(ReportedTrack, WhoStandsHasBothFeetOnTheGround) {
  const TemporaryFolder folder;
  March walk = march();
  TrackedFrames frames{walk.rate, FrameFile(folder / "frames.bin")};
  for (size_t i = 0; i < 40; ++i) {
    FrameRecord record = walk.record(0);
    record.modes.standing = i < 30 ? 0.9 : 0.1;
    frames.records.append(record);
  }
  const std::vector<FlatFoot> flat = standing_feet(frames);
  ASSERT_EQ(flat.size(), 2u);
  for (const FlatFoot& each : flat) {
    EXPECT_EQ(each.first, 0u);
    EXPECT_EQ(each.last, 29u);
  }
}

// A subject who is said to stand but moves on has no foot that could be held in place.
TEST(ReportedTrack, WhoGetsOnStandsNowhere) {
  const TemporaryFolder folder;
  const March walk = march();
  TrackedFrames frames{walk.rate, FrameFile(folder / "frames.bin")};
  for (size_t i = 0; i < 60; ++i) {
    FrameRecord record = walk.record(i);
    record.modes.standing = i < 30 ? 0.9 : 0.1;
    frames.records.append(record);
  }
  for (const FlatFoot& each : standing_feet(frames)) EXPECT_GE(each.first, 30u);
}

}  // namespace
}  // namespace walktrack
