#include "tracker/others/nearby_people.h"

#include <algorithm>

#include <gtest/gtest.h>

#include "core/conventions.h"
#include "tracker/others/person_boxes.h"
#include "tracker/tracker.h"
#include "walked_scene.h"

namespace walktrack {
namespace {

// Adds what somebody else covers.
void cover(const Camera& camera, const Body& body, const Pose& pose, CameraEvidence& seen) {
  const CameraEvidence theirs = evidence_of(camera, body, pose);
  std::vector<float> row(kEvidenceWidth);
  for (int y = 0; y < kEvidenceHeight; ++y) {
    for (int x = 0; x < kEvidenceWidth; ++x)
      row[static_cast<size_t>(x)] =
          static_cast<float>(std::max(log_ratio_at(seen.planes, Appearance{}, x, y),
                                      log_ratio_at(theirs.planes, Appearance{}, x, y)));
    set_row(seen.planes, 0, y, row, 4);
  }
}

// The subject walks along +x, 4 m before the camera; somebody else walks the other way.
class NearbyPeopleTest : public WalkedScene {
 protected:
  static constexpr size_t kFrames = 40;

  Eigen::Vector2d subject_in(size_t frame) const {
    return moved(walk_, static_cast<double>(frame) * kDt).position;
  }
  Eigen::Vector2d other_in(size_t frame) const {
    return moved(other_, static_cast<double>(frame) * kDt).position;
  }
  static void expect(const Eigen::Vector2d& place, NearbyPeople& people) {
    people.subject.mean.head<2>() = place;
  }

  // `until`: the first frame in which the other one is gone.
  void show_both(size_t until = kFrames) {
    const BodyModel model = test_model();
    const std::vector<Pose> figures = walking_figures(model, prior_, kSpeed, kPi);
    const Camera camera = camera_at({0, -4, 1}, {0, 0, 0.9}, 200, kEvidenceWidth, kEvidenceHeight);
    show(0.2, kFrames, {{0, -4, 1}}, [&](size_t frame, CameraEvidence& seen) {
      if (frame >= until) return;
      Pose pose = figures[frame / 3 % figures.size()];
      pose.root.head<2>() = other_in(frame);
      pose.heading = kPi;
      cover(camera, model.body, pose, seen);
    });
  }

  NearbyPeople after(size_t frames) const {
    NearbyPeople people = alone(walk_.position, walk_.velocity);
    for (size_t i = 0; i < frames; ++i) {
      expect(subject_in(i), people);
      follow_others(subject_->context(), window_[i], people);
    }
    return people;
  }

  // Evidence for or against a body around a place, sum of absolute values, nats.
  double evidence_around(const SceneEvidence& frame, const Eigen::Vector2d& place) const {
    const PixelRect box =
        intersection(person_box(subject_->context(), 0, place, 0.05), frame[0].planes.area);
    double sum = 0;
    for (int y = box.y0; y < box.y1; ++y)
      for (int x = box.x0; x < box.x1; ++x)
        sum += std::abs(log_ratio_at(frame[0].planes, Appearance{}, x, y));
    return sum;
  }

  DetectedWalk other_{.position = {1.1, 0.9}, .velocity = {-1.2, 0}};
};

TEST_F(NearbyPeopleTest, WhoIsAloneHasNobodyNear) {
  show(0.2, kFrames, {{0, -4, 1}});
  const NearbyPeople people = after(kFrames);
  EXPECT_FALSE(somebody_is_near(people));
  EXPECT_FALSE(without_others(subject_->context(), people, window_.back()));
}

TEST_F(NearbyPeopleTest, WhoComesTheOtherWayIsFollowedPastTheSubject) {
  show_both();
  for (const size_t frames : {size_t{6}, kFrames}) {  // they pass one another in frame 23
    const NearbyPeople people = after(frames);
    ASSERT_EQ(people.others.size(), 1);
    const MovingPerson& found = people.others[0].place;
    EXPECT_NEAR(found.position().x(), other_in(frames - 1).x(), 0.2) << frames;
    if (frames < kFrames) continue;
    EXPECT_NEAR(found.velocity().x(), other_.velocity.x(), 0.4);
  }
}

TEST_F(NearbyPeopleTest, PixelsOfSomebodyElseAreNoEvidence) {
  constexpr size_t kLast = 9;
  show_both();
  NearbyPeople people = after(kLast + 1);
  const auto rest = without_others(subject_->context(), people, window_[kLast]);
  ASSERT_TRUE(rest);
  EXPECT_GT(evidence_around(window_[kLast], other_in(kLast)), 500);
  EXPECT_EQ(evidence_around(*rest, other_in(kLast)), 0);
  EXPECT_EQ(evidence_around(*rest, subject_in(kLast)),
            evidence_around(window_[kLast], subject_in(kLast)));
}

TEST_F(NearbyPeopleTest, WhoWasSeenOnceIsNotCertain) {
  show_both();
  const NearbyPeople people = after(1);
  EXPECT_TRUE(somebody_is_near(people));
  EXPECT_FALSE(without_others(subject_->context(), people, window_[0]));
}

TEST_F(NearbyPeopleTest, WhoIsGoneIsForgotten) {
  show_both(1);
  EXPECT_FALSE(somebody_is_near(after(2)));  // who was not certain at once
  show_both(12);
  NearbyPeople people = after(kFrames);
  EXPECT_TRUE(somebody_is_near(people));
  for (int i = 0; i < 50; ++i) follow_others(subject_->context(), window_.back(), people);
  EXPECT_FALSE(somebody_is_near(people));
}

TEST_F(NearbyPeopleTest, WhatIsExpectedOfTheSubjectFollowsTheTrackUntilSomebodyIsInFront) {
  show_both();
  const TrackContext context = subject_->context();
  const auto moved_by = [&](NearbyPeople people, const Eigen::Vector2d& from) {
    expect(from, people);
    const MovingPerson straight_on = predicted(people.subject, kDt);
    expect_subject(context, from + Eigen::Vector2d(0.3, 0), people);
    return people.subject.position().x() - straight_on.position().x();
  };
  const NearbyPeople apart = after(6), passing = after(24);
  const double followed = moved_by(apart, subject_in(5));
  EXPECT_GT(followed, 0.05);
  EXPECT_LT(moved_by(passing, subject_in(23)), 0.5 * followed);
}

TEST_F(NearbyPeopleTest, TheWindowOfASearchLeavesThemOutUntilThatIsUndone) {
  other_.position.y() = -1;
  show_both();
  WalkSearch search;
  for (const SceneEvidence& frame : window_) search.push(frame);
  FoundWalk found{walk_};
  const NearbyPeople people = search.hide_others(subject_->context(), found);
  EXPECT_TRUE(somebody_is_near(people));
  EXPECT_LT((people.subject.position() - subject_in(kFrames)).norm(), 1e-9);
  EXPECT_LT(found.walk.score, 0);  // less of the figure has evidence than before
  EXPECT_NE(search.window().back()[0].planes.prefix, window_.back()[0].planes.prefix);
  search.restore_evidence(subject_->context());
  for (size_t i = 0; i < kFrames; ++i)
    EXPECT_EQ(search.window()[i][0].planes.prefix, window_[i][0].planes.prefix) << i;
}

// Whom the tracker follows in a scene that states where the walk begins.
class TrackBesideOthers : public NearbyPeopleTest {
 protected:
  // The smallest share of the tracked figure that has evidence in a frame.
  double least_seen(bool others) const {
    TrackerScene scene = subject_->scene;
    scene.initial = walk_;
    scene.initial->given = true;
    scene.initial_phase = 0.2;
    TrackerConfig config;
    config.detector.window = 0.5;  // s, so that they pass one another after the start
    config.others = others;
    Tracker tracker(scene, prior_, config, 1, 1);
    std::vector<FrameRecord> records;
    const auto keep = [&](std::vector<FrameRecord> more) {
      for (FrameRecord& record : more) records.push_back(std::move(record));
    };
    for (const SceneEvidence& frame : window_) keep(tracker.push(frame));
    EXPECT_EQ(tracker.somebody_is_near(), others);
    EXPECT_EQ(tracker.frames_beside_others() > 5, others);
    keep(tracker.finish());
    double least = 1;
    for (const FrameRecord& record : records)
      if (record.tracked) least = std::min(least, record.fit.seen[0]);
    EXPECT_EQ(records.size(), kFrames);
    return least;
  }
};

TEST_F(TrackBesideOthers, HasNoEvidenceWhereSomebodyIsInFront) {
  other_.position.y() = -1;
  show_both();
  EXPECT_LT(least_seen(true), 0.6);
  EXPECT_EQ(least_seen(false), 1);
}

// The boxes of people.
class PersonBoxes : public WalkedScene {
 protected:
  // Whether the pixel that shows a place at hip height has evidence about somebody at `own`.
  bool has_evidence(const Eigen::Vector2d& shown, const Eigen::Vector2d& own,
                    const std::vector<Eigen::Vector2d>& others) {
    show(0, 1, {{0, -4, 1}});
    SceneEvidence frame = outlines_of(window_[0]);
    hide_others(subject_->context(), others, own, frame);
    const auto pixel = project(subject_->scene.cameras[0], {shown.x(), shown.y(), 0.9});
    return log_ratio_at(frame[0].planes, Appearance{}, static_cast<int>(std::lround(pixel->x())),
                        static_cast<int>(std::lround(pixel->y()))) != 0;
  }
};

TEST_F(PersonBoxes, APixelBelongsToWhomItIsNearer) {
  const Eigen::Vector2d own(0, 0), other(0.5, 0.1);
  EXPECT_TRUE(has_evidence({0, 0}, own, {other}));
  EXPECT_TRUE(has_evidence({0.24, 0}, own, {other}));  // in both boxes, as the next one
  EXPECT_FALSE(has_evidence({0.35, 0}, own, {other}));
  EXPECT_FALSE(has_evidence({0.6, 0}, own, {other}));
  EXPECT_TRUE(has_evidence({-1, 0}, own, {other}));  // of neither
}

TEST_F(PersonBoxes, WhoIsNearerToTheCameraHidesWhoIsBehind) {
  EXPECT_FALSE(has_evidence({0, 0}, {0, 0}, {{0.02, -1}}));
  EXPECT_TRUE(has_evidence({0, 0}, {0, 0}, {{0.02, 1}}));
}

TEST_F(PersonBoxes, PeopleOverlapIfTheyDoInEveryPicture) {
  show(0, 1, {{0, -4, 1}});
  EXPECT_TRUE(behind_one_another(subject_->context(), {0, 0}, {0.1, 1}));
  EXPECT_FALSE(behind_one_another(subject_->context(), {0, 0}, {1, 0}));
  show(0, 1, {{0, -4, 1}, {4, 0, 1}});
  EXPECT_FALSE(behind_one_another(subject_->context(), {0, 0}, {0.1, 1}));
}

}  // namespace
}  // namespace walktrack
