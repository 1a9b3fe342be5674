// Whether the subject has left every picture. What the tracker then expects is not reported: it is
// not seen, and an estimate of it grows wrong by a step within half a second.
#pragma once

#include <span>

#include "camera/camera.h"
#include "tracker/smooth/estimate.h"

namespace walktrack {
inline namespace jobs {

// A figure is out of the picture if none of its joints is in an image, and from then on as long as
// its hips are in none. `before`: whether it was out of the picture in the frame before.
bool out_of_picture(std::span<const Camera> cameras, const FrameEstimate& figure, bool before);

}  // namespace jobs
}  // namespace walktrack
