// The built-in pose detector: MoveNet SinglePose, run by OpenCV's dnn module. It looks at a cut-out
// around a person and says where the 17 points of COCO are; it has none of the feet.
//
// The same picture gives the same points on any number of threads as long as OpenCV itself is kept
// on one (cv::setNumThreads(1)): it splits layers by its threads and adds in another order then.
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

class PoseNet {
 public:
  // From an ONNX file's content; InputError naming `name` where that is no network of this family.
  // Without the dnn module, always.
  PoseNet(std::string_view file, const std::string& name);
  PoseNet(PoseNet&&) noexcept;
  PoseNet& operator=(PoseNet&&) noexcept;
  ~PoseNet();

  // The person nearest the cut-out's middle, in pixels of the picture (8-bit BGR); what is outside
  // it is black. There always is an answer: of nobody, with low confidences.
  DetectedPerson detect(const cv::Mat& picture, const CutOut& cut_out);

 private:
  struct Net;
  std::unique_ptr<Net> net_;
};

}  // namespace observation
}  // namespace walktrack
