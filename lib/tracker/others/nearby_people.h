// Other people who move near the subject. A rigid figure with the usual gait follows each of them
// at a nearly constant velocity, and their pixels are no evidence about the subject, so that who
// crosses or walks beside the subject does not take the track along.
//
// As long as two people are in front of one another, the pictures hardly show who is who, and count
// little; what is expected of both is then that they walk on. reports/other_people.md has
// measurements.
#pragma once

#include <optional>
#include <vector>

#include <Eigen/Core>

#include "tracker/others/moving_person.h"
#include "tracker/subject_model.h"

namespace walktrack {
inline namespace tracker {

struct OtherPerson {
  MovingPerson place;  // in the newest frame
  int seen = 0;        // frames in which the figure explained something
  int unseen = 0;      // the newest ones, in which it did not
};

struct NearbyPeople {
  MovingPerson subject;    // as expected in the next frame
  double usual_score = 0;  // of a rigid figure at the subject's place, nats; a moving mean
  int frames = 0;          // in which others were followed or looked for
  std::vector<OtherPerson> others;
};

// Nobody else is known; the subject is expected at that place in the next frame, m and m/s.
NearbyPeople alone(const Eigen::Vector2d& position, const Eigen::Vector2d& velocity);

// Follows the others into the next frame, whose evidence may be that of the subject's surroundings
// only, and looks for somebody new.
void follow_others(const TrackContext& context, const SceneEvidence& evidence,
                   NearbyPeople& people);

// Whether anybody else is known for certain, or suspected, as somebody seen for the first time is.
bool somebody_is_near(const NearbyPeople& people);

// The evidence without the pixels of the others, if they are known for certain; otherwise nullopt.
std::optional<SceneEvidence> without_others(const TrackContext& context, const NearbyPeople& people,
                                            const SceneEvidence& evidence);

// To be called after the frame with the place of the track.
void expect_subject(const TrackContext& context, const Eigen::Vector2d& place,
                    NearbyPeople& people);

}  // namespace tracker
}  // namespace walktrack
