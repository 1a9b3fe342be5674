#include "jobs/track/out_of_picture.h"

#include "camera/inspection.h"

namespace walktrack {
inline namespace jobs {

bool out_of_picture(std::span<const Camera> cameras, const FrameEstimate& figure, bool before) {
  if (before) return !in_any_picture(cameras, figure.joints[Joint::kPelvis]);
  for (size_t j = 0; j < figure.joint_count; ++j)
    if (in_any_picture(cameras, figure.joints.at[j])) return false;
  return true;
}

}  // namespace jobs
}  // namespace walktrack
