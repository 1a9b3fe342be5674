// The built-in pose detector: MoveNet SinglePose, run by OpenCV's dnn module. It returns the 17
// points of COCO for a cut-out around a person; points of the feet are not among them.
//
// The same image gives the same points on any number of threads as long as OpenCV itself uses one
// (cv::setNumThreads(1)): it splits layers by its threads and then adds in another order.
#pragma once

#include <memory>
#include <string>
#include <string_view>

#include <opencv2/core/mat.hpp>

#include "observation/pose_net/pose_maps.h"

namespace walktrack {
inline namespace observation {

// Whether this program was built with OpenCV's dnn module.
bool has_pose_net();

// An image, 8-bit BGR, or a part of it, whose first pixel is `first`.
struct ImagePart {
  cv::Mat picture;
  cv::Point first{};
};

class PoseNet {
 public:
  // From the content of an ONNX file; InputError that names `name` if it is not a network of this
  // family, and always without the dnn module.
  PoseNet(std::string_view file, const std::string& name);
  PoseNet(PoseNet&&) noexcept;
  PoseNet& operator=(PoseNet&&) noexcept;
  ~PoseNet();

  // The person nearest to the cut-out's middle, in pixels of the image, which is continued in
  // black. There is always a result, which has low confidences if nobody is there.
  DetectedPerson detect(const ImagePart& image, const CutOut& cut_out);

 private:
  struct Net;
  std::unique_ptr<Net> net_;
};

}  // namespace observation
}  // namespace walktrack
