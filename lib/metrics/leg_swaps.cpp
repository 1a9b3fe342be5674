#include "metrics/leg_swaps.h"

#include <algorithm>
#include <array>

namespace walktrack {
inline namespace metrics {

namespace {

constexpr double kClearly = 0.1;  // m; less is within the noise of four joints; by hand
constexpr std::array kLeft{Joint::kLeftKnee, Joint::kLeftAnkle};
constexpr std::array kRight{Joint::kRightKnee, Joint::kRightAnkle};

bool legs_known(const JointPositions& joints) {
  return std::all_of(kLeft.begin(), kLeft.end(), [&](Joint j) { return known(joints[j]); }) &&
         std::all_of(kRight.begin(), kRight.end(), [&](Joint j) { return known(joints[j]); });
}

// Distance between the positions of the joints `bound` that follow from rows i - 2 and i - 1, and
// the joints `found` in row i.
double miss(const Motion& motion, size_t i, const std::array<Joint, 2>& bound,
            const std::array<Joint, 2>& found) {
  double sum = 0;
  for (size_t k = 0; k < bound.size(); ++k) {
    const Eigen::Vector3d expected =
        2 * motion.joints[i - 1][bound[k]] - motion.joints[i - 2][bound[k]];
    sum += (motion.joints[i][found[k]] - expected).norm();
  }
  return sum;
}

}  // namespace

size_t leg_swaps(const Motion& motion) {
  size_t swaps = 0, run = 0;
  for (size_t i = 0; i < motion.joints.size(); ++i) {
    run = legs_known(motion.joints[i]) ? run + 1 : 0;
    if (run < 3) continue;
    const double kept = miss(motion, i, kLeft, kLeft) + miss(motion, i, kRight, kRight);
    const double swapped = miss(motion, i, kLeft, kRight) + miss(motion, i, kRight, kLeft);
    if (swapped + kClearly >= kept) continue;
    ++swaps;
    run = 1;  // the jump itself cannot be used as a velocity
  }
  return swaps;
}

}  // namespace metrics
}  // namespace walktrack
