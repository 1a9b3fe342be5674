// DeepLabCut's tables have two or three rows of names above the columns, which are joined into one
// row here.
#pragma once

#include <string>

#include "io/keypoints/keypoint_file.h"

namespace walktrack {
inline namespace io {

KeypointFrames deeplabcut_table(const std::string& text, const KeypointSource& source);

}  // namespace io
}  // namespace walktrack
