// Replaces pose_net.cpp if OpenCV has no dnn module.
#include "core/errors.h"
#include "observation/pose_net/pose_net.h"

namespace walktrack {
inline namespace observation {

struct PoseNet::Net {};

bool has_pose_net() { return false; }

PoseNet::PoseNet(std::string_view, const std::string& name) {
  throw InputError(name + ": this program was built without OpenCV's dnn module, which runs it");
}

PoseNet::PoseNet(PoseNet&&) noexcept = default;
PoseNet& PoseNet::operator=(PoseNet&&) noexcept = default;
PoseNet::~PoseNet() = default;

DetectedPerson PoseNet::detect(const ImagePart&, const CutOut&) { return {}; }

}  // namespace observation
}  // namespace walktrack
