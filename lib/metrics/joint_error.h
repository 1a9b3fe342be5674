// Distances between estimated and true joint centres, and how often left and right were swapped.
//
// Sources define neck, head and toes differently, so that the main errors use the seven joints that
// all define alike: pelvis, hips, knees and ankles. A frame of the truth is filled if the estimate
// knows all seven; evaluation starts at the first filled frame (initialisation). The estimate is
// resampled at the truth's times. Metres, seconds.
#pragma once

#include <array>
#include <limits>
#include <vector>

#include <Eigen/Core>

#include "body/motion.h"
#include "metrics/statistics/statistics.h"

namespace walktrack {
inline namespace metrics {

inline constexpr std::array<Joint, 7> kScoredJoints{
    Joint::kPelvis,   Joint::kLeftHip,   Joint::kLeftKnee,  Joint::kLeftAnkle,
    Joint::kRightHip, Joint::kRightKnee, Joint::kRightAnkle};

struct JointErrors {
  double start = std::numeric_limits<double>::quiet_NaN();  // s, first filled truth frame
  size_t frames = 0;                                        // truth frames from then on
  double filled_share = 0;                                  // of those
  // Share of the filled frames in which a knee and its ankle are both nearer to the other side's
  // truth while the ankles are more than 0.25 m apart.
  double swapped_share = 0;
  // Statistics over frames of the mean over the seven joints: without alignment; after moving the
  // estimated pelvis to the true one; after the similarity (rotation, translation, scale) that fits
  // the seven best in each frame (Procrustes; Umeyama 1991).
  ErrorStatistics absolute, pelvis_relative, procrustes;
  // The same for each joint; count 0 if never both are known.
  struct OfJoint {
    ErrorStatistics absolute, pelvis_relative, procrustes;
  };
  std::array<OfJoint, kJointCount> by_joint;
  // The absolute error of each frame, NaN where it is not filled.
  std::vector<double> time, by_frame;
  // Mean of estimated minus true pelvis: along the true direction of walking, to its left, up. The
  // direction is that of the pelvis over a second; NaN if it hardly moves.
  Eigen::Vector3d mean_offset = Eigen::Vector3d::Constant(std::numeric_limits<double>::quiet_NaN());
  // Estimated over true length of thighs and shanks, mean over frames; NaN without frames.
  double leg_length_ratio = std::numeric_limits<double>::quiet_NaN();
};

// Throws InputError if the seven joints are known in no frame of the truth.
JointErrors joint_errors(const Motion& truth, const Motion& estimate);

bool scored_joints_known(const JointPositions& joints);

// An estimate at the truth's times: interpolated between neighbouring rows; across a missing row it
// is unknown.
Motion at_times_of(const Motion& truth, const Motion& estimate);

}  // namespace metrics
}  // namespace walktrack
