#include "observation/pose_net/pose_net.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstring>
#include <fstream>

#include <opencv2/core.hpp>
#include <opencv2/imgproc.hpp>
#include <opencv2/videoio.hpp>

#include "observation/pose_net/net_file.h"
#include "tests/message_of.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

using testing::HasSubstr;

std::string shipped() {
  return read_file(WALKTRACK_SOURCE_DIR "/data/pose_net/movenet_lightning.onnx");
}

// Sets the number of OpenCV's threads for the duration of a test.
class Threads {
 public:
  explicit Threads(int count) : before_(cv::getNumThreads()) { cv::setNumThreads(count); }
  ~Threads() { cv::setNumThreads(before_); }

 private:
  int before_;
};

// A frame of the woman who walks past, seen from the side; empty without the shared data.
cv::Mat side_view() {
  cv::VideoCapture video(std::string(WALKTRACK_SOURCE_DIR) +
                         "/../shared/data/sports2d_side/video.mp4");
  cv::Mat frame;
  for (int i = 0; i <= 40; ++i) video.read(frame);
  return frame;
}

constexpr CutOut kWoman{1000, 490, 500};

TEST(NetFile, WidensHalfPrecision) {
  const std::string half = shipped();
  const NetFile wide = widened_net(half, "net");
  EXPECT_EQ(wide.side_px, 192);
  EXPECT_GT(wide.onnx.size(), 1.9 * static_cast<double>(half.size()));
  EXPECT_EQ(widened_net(wide.onnx, "net").onnx, wide.onnx);  // no weights are left to convert
}

TEST(NetFile, RefusesOtherFiles) {
  const std::string net = shipped();
  EXPECT_THAT(message_of([] { widened_net("hello", "x.onnx"); }),
              HasSubstr("x.onnx: found no ONNX file, allowed: an ONNX file of a pose network"));
  EXPECT_THAT(message_of([] { widened_net("", "x.onnx"); }), HasSubstr("another kind of input"));
  EXPECT_THAT(message_of([&] { widened_net(net.substr(0, net.size() / 2), "x"); }),
              HasSubstr("no ONNX file"));
}

TEST(PoseNet, RefusesWhatItCannotRun) {
  if (!has_pose_net()) GTEST_SKIP() << "built without OpenCV's dnn module";
  std::string net = shipped();
  const std::string_view name = "heat_out";
  size_t at = net.find(name);
  ASSERT_NE(at, std::string::npos);
  for (; at != std::string::npos; at = net.find(name, at)) net.replace(at, name.size(), "heat_not");
  EXPECT_THAT(message_of([&] { PoseNet(net, "x.onnx"); }), HasSubstr("x.onnx: found a network"));
}

// A person drawn with a few lines gets a low confidence; an empty image an even lower one.
TEST(PoseNet, SeesNobodyInAnEmptyPicture) {
  if (!has_pose_net()) GTEST_SKIP() << "built without OpenCV's dnn module";
  const Threads one(1);
  PoseNet net(shipped(), "net");
  const cv::Mat grey(300, 400, CV_8UC3, cv::Scalar::all(90));
  for (const Keypoint& point : net.detect({grey}, {0, 0, 300}).points)
    EXPECT_LT(point.confidence, 0.2);
}

// A larger network of the family, as data/sports2d_side/keypoints has it, sees them there.
TEST(PoseNet, FindsAPersonsJoints) {
  if (!has_pose_net()) GTEST_SKIP() << "built without OpenCV's dnn module";
  const cv::Mat frame = side_view();
  if (frame.empty()) GTEST_SKIP() << "no ../shared/data/sports2d_side";
  const Threads one(1);
  PoseNet net(shipped(), "net");
  const DetectedPerson person = net.detect({frame}, kWoman);
  struct Row {
    KeypointName name;
    double x_px, y_px;
  };
  for (const Row& row :
       {Row{KeypointName::kNose, 1237, 563}, Row{KeypointName::kLeftHip, 1265, 728},
        Row{KeypointName::kLeftKnee, 1210, 802}, Row{KeypointName::kLeftAnkle, 1195, 905},
        Row{KeypointName::kRightAnkle, 1310, 912}}) {
    EXPECT_GT(person[row.name].confidence, 0.3);
    EXPECT_NEAR(person[row.name].x_px, row.x_px, 20);
    EXPECT_NEAR(person[row.name].y_px, row.y_px, 20);
  }
}

// If the image is shifted, the points are shifted by as much.
TEST(PoseNet, FollowsThePicture) {
  if (!has_pose_net()) GTEST_SKIP() << "built without OpenCV's dnn module";
  const cv::Mat frame = side_view();
  if (frame.empty()) GTEST_SKIP() << "no ../shared/data/sports2d_side";
  const Threads one(1);
  PoseNet net(shipped(), "net");
  const DetectedPerson here = net.detect({frame}, kWoman);
  cv::Mat moved;
  cv::copyMakeBorder(frame, moved, 40, 0, 60, 0, cv::BORDER_CONSTANT);
  const DetectedPerson there =
      net.detect({moved}, {kWoman.x0 + 60, kWoman.y0 + 40, kWoman.side_px});
  for (size_t k = 0; k < kCocoPoints; ++k) {
    EXPECT_FLOAT_EQ(there.points[k].x_px, here.points[k].x_px + 60);
    EXPECT_FLOAT_EQ(there.points[k].y_px, here.points[k].y_px + 40);
  }
}

// The part of a frame under the cut-out says what the frame says, also at its border.
TEST(PoseNet, NeedsOnlyThePixelsOfTheCutOut) {
  if (!has_pose_net()) GTEST_SKIP() << "built without OpenCV's dnn module";
  const cv::Mat frame = side_view();
  if (frame.empty()) GTEST_SKIP() << "no ../shared/data/sports2d_side";
  const Threads one(1);
  PoseNet net(shipped(), "net");
  for (const CutOut& cut_out : {kWoman, CutOut{kWoman.x0, kWoman.y0 + 300, kWoman.side_px}}) {
    const DetectedPerson whole = net.detect({frame}, cut_out);
    const cv::Rect there = part_within(cut_out, frame.cols, frame.rows);
    const DetectedPerson part = net.detect({frame(there), there.tl()}, cut_out);
    for (size_t k = 0; k < kCocoPoints; ++k) {
      EXPECT_EQ(part.points[k].x_px, whole.points[k].x_px);
      EXPECT_EQ(part.points[k].y_px, whole.points[k].y_px);
    }
  }
}

TEST(PoseNet, SaysTheSameTwice) {
  if (!has_pose_net()) GTEST_SKIP() << "built without OpenCV's dnn module";
  const cv::Mat frame = side_view();
  if (frame.empty()) GTEST_SKIP() << "no ../shared/data/sports2d_side";
  const Threads one(1);
  PoseNet first(shipped(), "net"), second(shipped(), "net");
  second.detect({frame}, {0, 0, 500});
  const DetectedPerson a = first.detect({frame}, kWoman), b = second.detect({frame}, kWoman);
  EXPECT_EQ(std::memcmp(&a, &b, sizeof a), 0);
}

}  // namespace
}  // namespace walktrack
