// The independently rendered walks below ../shared/data/rendered, if they exist: calibration,
// frames, true joints, and the parts of the body model at these joints.
#pragma once

#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <opencv2/core.hpp>
#include <opencv2/videoio.hpp>

#include "body/body.h"
#include "body/kinematics.h"
#include "camera/camera.h"
#include "core/errors.h"

namespace walktrack {

inline std::filesystem::path shared_data() {
  return std::filesystem::path(WALKTRACK_SOURCE_DIR) / "../shared/data";
}

inline Camera read_camera(const std::filesystem::path& path) {
  cv::FileStorage file(path.string(), cv::FileStorage::READ);
  if (!file.isOpened()) throw InputError("cannot read " + path.string());
  cv::Mat k, d, r, t;
  file["camera_matrix"] >> k;
  file["distortion_coefficients"] >> d;
  file["rotation"] >> r;
  file["translation"] >> t;
  Camera camera;
  camera.width_px = static_cast<int>(file["image_width"]);
  camera.height_px = static_cast<int>(file["image_height"]);
  camera.focal_px = {k.at<double>(0, 0), k.at<double>(1, 1)};
  camera.centre_px = {k.at<double>(0, 2), k.at<double>(1, 2)};
  for (int i = 0; i < 3; ++i) {
    camera.translation[i] = t.at<double>(i);
    for (int j = 0; j < 3; ++j) camera.rotation(i, j) = r.at<double>(i, j);
  }
  set_distortion(camera, {d.ptr<double>(), d.total()});
  return camera;
}

inline std::vector<cv::Mat> read_frames(const std::filesystem::path& path, int most = 1 << 30) {
  cv::VideoCapture video(path.string());
  std::vector<cv::Mat> frames;
  for (cv::Mat frame; static_cast<int>(frames.size()) < most && video.read(frame);)
    frames.push_back(frame.clone());
  return frames;
}

// The columns of a joints.csv in the order of Joint (without the time).
inline std::vector<JointPositions> read_truth(const std::filesystem::path& path) {
  std::ifstream file(path);
  std::vector<JointPositions> rows;
  std::string line;
  std::getline(file, line);
  while (std::getline(file, line)) {
    std::stringstream cells(line);
    std::string cell;
    std::getline(cells, cell, ',');
    JointPositions joints;
    for (Eigen::Vector3d& p : joints.at) {
      for (double& x : p) {
        std::getline(cells, cell, ',');
        x = std::stod(cell);
      }
    }
    rows.push_back(joints);
  }
  return rows;
}

// Segment axes from an upward (or, for the feet, forward) direction and a leftward hint.
inline Eigen::Matrix3d axes_up(const Eigen::Vector3d& up, const Eigen::Vector3d& left) {
  Eigen::Matrix3d axes;
  axes.col(2) = up.normalized();
  axes.col(0) = left.cross(up).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  return axes;
}

// A skeleton whose segments are directed along the given joints, whatever the body's lengths.
inline Skeleton skeleton_from_joints(const Body& body, const JointPositions& j) {
  Skeleton s;
  s.joints = j;
  const Eigen::Vector3d left = (j[Joint::kLeftHip] - j[Joint::kRightHip]).normalized();
  const auto set = [&](Segment name, const Eigen::Matrix3d& axes) {
    s.world_from_segment[static_cast<size_t>(name)] = axes;
  };
  set(Segment::kPelvis, axes_up(j[Joint::kNeck] - j[Joint::kPelvis], left));
  set(Segment::kTrunk, axes_up(j[Joint::kNeck] - j[Joint::kPelvis], left));
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const bool l = side == Side::kLeft;
    set(l ? Segment::kLeftThigh : Segment::kRightThigh,
        axes_up(j[hip(side)] - j[knee(side)], left));
    set(l ? Segment::kLeftShank : Segment::kRightShank,
        axes_up(j[knee(side)] - j[ankle(side)], left));
    const Joint shoulder = l ? Joint::kLeftShoulder : Joint::kRightShoulder;
    const Joint elbow = l ? Joint::kLeftElbow : Joint::kRightElbow;
    const Joint wrist = l ? Joint::kLeftWrist : Joint::kRightWrist;
    set(l ? Segment::kLeftUpperArm : Segment::kRightUpperArm,
        axes_up(j[shoulder] - j[elbow], left));
    set(l ? Segment::kLeftForearm : Segment::kRightForearm, axes_up(j[elbow] - j[wrist], left));
    // The ball is in front of and below the ankle; the foot's x axis is along the sole.
    const BodyLengths& lengths = body.lengths;
    const double drop =
        std::atan2(lengths.ankle_height - lengths.ball_height, lengths.ball_forward);
    const Eigen::Vector3d to_ball = j[toe(side)] - j[ankle(side)];
    set(l ? Segment::kLeftFoot : Segment::kRightFoot,
        axes_up(Eigen::AngleAxisd(-drop, left) * to_ball.cross(left), left));
  }
  return s;
}

}  // namespace walktrack
