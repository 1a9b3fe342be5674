#include "jobs/optimise/outliers.h"

#include <array>
#include <vector>

#include "core/median.h"

namespace walktrack {
inline namespace jobs {

namespace {

constexpr size_t kFewest = 2;  // rows on either side

// How many rows on either side of a row are its neighbours. Equally many, for a joint that moves
// evenly is in the middle of them.
size_t neighbours(const Motion& motion, size_t row) {
  size_t count = 0;
  while (count < row && row + count + 1 < motion.time.size() &&
         motion.time[row] - motion.time[row - count - 1] <= kNeighbours &&
         motion.time[row + count + 1] - motion.time[row] <= kNeighbours)
    ++count;
  return count;
}

// Of one joint over the rows around one of them; the joint itself if it has too few neighbours.
Eigen::Vector3d median_around(const Motion& motion, size_t row, size_t joint) {
  const size_t count = neighbours(motion, row);
  std::array<std::vector<double>, 3> values;
  for (size_t i = row - count; i <= row + count; ++i) {
    const Eigen::Vector3d& at = motion.joints[i].at[joint];
    if (!known(at)) continue;
    for (size_t axis = 0; axis < 3; ++axis)
      values[axis].push_back(at[static_cast<Eigen::Index>(axis)]);
  }
  if (values[0].size() < 2 * kFewest + 1) return motion.joints[row].at[joint];
  return {median_of(values[0]), median_of(values[1]), median_of(values[2])};
}

}  // namespace

size_t replace_outliers(Motion& motion) {
  const Motion before = motion;
  size_t replaced = 0;
  for (size_t row = 0; row < motion.time.size(); ++row) {
    for (size_t joint = 0; joint < kJointCount; ++joint) {
      Eigen::Vector3d& at = motion.joints[row].at[joint];
      if (!known(at)) continue;
      const Eigen::Vector3d middle = median_around(before, row, joint);
      if ((at - middle).norm() <= kFarOff) continue;
      at = middle;
      ++replaced;
    }
  }
  return replaced;
}

}  // namespace jobs
}  // namespace walktrack
