// Measures of a motion that need no truth: feet that slide, feet below the ground, jitter, steps
// that do not fit the path of the body, and speeds that are too high for a walk.
#pragma once

#include "body/motion.h"
#include "metrics/gait.h"

namespace walktrack {
inline namespace metrics {

struct Plausibility {
  // Largest horizontal displacement of (ankle + toe) / 2 in the flat part of a complete stance:
  // mean and worst over stances, m. 0 without such a stance. Measured people: up to 12 mm.
  double mean_foot_slide = 0, worst_foot_slide = 0;
  double mean_slide_along = 0;  // along the direction of walking alone, mean over stances, m
  size_t stances = 0;           // that were counted
  // Largest depth of an ankle or toe below the ground, and the share of rows with more than 5 mm.
  double penetration = 0;
  double penetrating_share = 0;
  // Mean magnitude of the third derivative of the seven scored joints, m/s^3.
  double jitter = 0;
  // Along the direction of walking, m; 0 without steps.
  double longest_step = 0, shortest_step = 0;
  // The shortest time from one strike to the next, as a share of the median one; the time to the
  // next strike of the same foot counts as two. 1 with less than three times.
  double quickest_step = 1;
  // |sum of the steps' lengths / way of the pelvis between the same strikes - 1|: 0 if the feet
  // move as far as the body, and without steps.
  double steps_off_way = 0;
  // Steps that are missing on the way of the pelvis: its length in steps of the mean length, less
  // the complete steps and two incomplete ones, at the beginning and at the end of every walk.
  double missing_steps = 0;
  // Speed of the pelvis over the ground in the fastest half second of known rows, m/s.
  double fastest = 0;
};

Plausibility plausibility(const Motion& motion, const Gait& gait);

}  // namespace metrics
}  // namespace walktrack
