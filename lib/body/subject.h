// The subject who is tracked. Stature and mass determine every segment.
//
// Segment lengths: core/anthropometry.h, and Winter, "Biomechanics and Motor Control of Human
// Movement", 4th ed. 2009, table 4.1 (Dempster) and fig. 4.1 (Drillis & Contini).
// Breadths, depths and circumferences: Gordon et al., "1988 Anthropometric Survey of U.S. Army
// Personnel", 1989, male medians divided by the median stature 1.756 m. Metres, kilograms.
#pragma once

#include <optional>

namespace walktrack {
inline namespace body {

// Lengths that a scene may state, metres; the others follow from the stature.
struct SubjectLengths {
  std::optional<double> thigh, shank, foot, ankle_height, trunk, hip_width, shoulder_width,
      upper_arm, forearm;
};

struct Subject {
  double height = 1.75;
  double mass = 70;
  SubjectLengths lengths;
  double girth = 1;  // factor of all breadths and depths except those of head and feet
};

// Resolved lengths of one body, metres.
struct BodyLengths {
  double thigh;           // hip centre to knee centre
  double shank;           // knee centre to ankle centre
  double ankle_height;    // ankle centre above the sole
  double foot;            // heel to tip of the toes
  double ball_forward;    // ankle to the ball of the foot (2nd metatarsal head), along the sole
  double ball_height;     // ball centre above the sole
  double hip_width;       // between the hip centres
  double trunk;           // hip axis to shoulder height
  double neck;            // hip axis to the height of C7
  double head;            // hip axis to the centre of the head, trunk and neck straight
  double shoulder_width;  // between the shoulder centres
  double upper_arm;       // shoulder to elbow
  double forearm;         // elbow to wrist
};

BodyLengths body_lengths(const Subject& subject);

// Length of the straight leg from the hip centre to the sole, the unit of dimensionless gait.
double leg_length(const BodyLengths& lengths);

}  // namespace body
}  // namespace walktrack
