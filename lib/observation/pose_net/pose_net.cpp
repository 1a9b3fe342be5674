#include "observation/pose_net/pose_net.h"

#include <array>
#include <vector>

#include <opencv2/dnn.hpp>
#include <opencv2/imgproc.hpp>

#include "core/errors.h"
#include "observation/pose_net/net_file.h"

namespace walktrack {
inline namespace observation {

namespace {

const std::array<std::string, 4> kMaps{"center_out", "heat_out", "regress_out", "offset_out"};
constexpr std::array<int, 4> kChannels{1, 17, 34, 34};

[[noreturn]] void fail(const std::string& name, std::string_view found) {
  throw InputError(
      describe({name, 0, ""}, found, "MoveNet SinglePose as scripts/make_pose_net.py writes it"));
}

// The cut-out at the network's size, black outside of the picture, whose first pixel is `first`.
cv::Mat cut(const cv::Mat& picture, const CutOut& cut_out, const cv::Point& first, int side_px) {
  const cv::Rect wanted = rectangle(cut_out) - first;
  const cv::Rect there = wanted & cv::Rect({}, picture.size());
  cv::Mat piece = cv::Mat::zeros(wanted.size(), CV_8UC3);
  if (!there.empty()) picture(there).copyTo(piece(there - wanted.tl()));
  cv::Mat out;
  cv::resize(piece, out, {side_px, side_px}, 0, 0,
             cut_out.side_px > side_px ? cv::INTER_AREA : cv::INTER_LINEAR);
  return out;
}

std::span<const float> values(const cv::Mat& map) { return {map.ptr<float>(), map.total()}; }

}  // namespace

struct PoseNet::Net {
  cv::dnn::Net net;
  int side_px = 0;
  std::vector<cv::Mat> maps{};
  const std::vector<cv::String> names{kMaps.begin(), kMaps.end()};

  void run(const cv::Mat& piece) {
    constexpr double kHalfRange = 127.5;
    net.setInput(
        cv::dnn::blobFromImage(piece, 1 / kHalfRange, {}, cv::Scalar::all(kHalfRange), true));
    net.forward(maps, names);
  }

  // Whether every output has a map with the expected channels; otherwise it is another network.
  bool fits() const {
    for (size_t i = 0; i < kMaps.size(); ++i) {
      const cv::MatSize& size = maps[i].size;
      const int side = side_px / kCell_px;
      if (maps[i].dims != 4 || size[1] != kChannels[i] || size[2] != side || size[3] != side)
        return false;
    }
    return true;
  }
};

bool has_pose_net() { return true; }

PoseNet::PoseNet(std::string_view file, const std::string& name) {
  const NetFile wide = widened_net(file, name);
  try {
    net_ = std::make_unique<Net>(
        Net{cv::dnn::readNetFromONNX(wide.onnx.data(), wide.onnx.size()), wide.side_px});
    net_->net.setPreferableBackend(cv::dnn::DNN_BACKEND_OPENCV);
    net_->run(cv::Mat::zeros(wide.side_px, wide.side_px, CV_8UC3));
  } catch (const cv::Exception&) {
    fail(name, "a network that OpenCV's dnn module cannot run");
  }
  if (!net_->fits()) fail(name, "a network with other outputs");
}

PoseNet::PoseNet(PoseNet&&) noexcept = default;
PoseNet& PoseNet::operator=(PoseNet&&) noexcept = default;
PoseNet::~PoseNet() = default;

DetectedPerson PoseNet::detect(const ImagePart& image, const CutOut& cut_out) {
  net_->run(cut(image.picture, cut_out, image.first, net_->side_px));
  const std::vector<cv::Mat>& maps = net_->maps;
  return decoded({net_->side_px / kCell_px, values(maps[0]), values(maps[1]), values(maps[2]),
                  values(maps[3])},
                 cut_out);
}

}  // namespace observation
}  // namespace walktrack
