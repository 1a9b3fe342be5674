#include "io/drawing/overlay.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <Eigen/Geometry>
#include <opencv2/imgproc.hpp>

#include "body/motion.h"
#include "io/drawing/sub_pixel.h"

namespace walktrack {
inline namespace io {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

const cv::Scalar kLeftBgr(178, 114, 0), kRightBgr(0, 94, 213), kTrunkBgr(255, 255, 255),
    kGridBgr(150, 150, 150);

constexpr int kMostPieces = 12;         // number of segments that a distorted line is drawn with,
                                        // at most
constexpr double kPiece = 32;           // px; shorter segments need no subdivision for any lens
constexpr double kFarOutside = 10'000;  // px; beyond it OpenCV's coordinates overflow

bool far_outside(const Vector2d& px) { return px.cwiseAbs().maxCoeff() > kFarOutside; }

void draw_piece(cv::Mat& image, const Vector2d& from, const Vector2d& to, const cv::Scalar& bgr,
                int thickness_px) {
  if (far_outside(from) || far_outside(to)) return;
  cv::line(image, fixed_point(from), fixed_point(to), bgr, thickness_px, cv::LINE_AA,
           kFractionBits);
}

// Number of segments for a line between these pixels. A line from behind the camera or from far
// outside is always subdivided, because some of its segments may be in the image.
int pieces_between(const std::optional<Vector2d>& from, const std::optional<Vector2d>& to) {
  if (!from || !to || far_outside(*from) || far_outside(*to)) return kMostPieces;
  return static_cast<int>(
      std::clamp<double>(std::ceil((*to - *from).norm() / kPiece), 1, kMostPieces));
}

struct Bone {
  Joint from, to;
  const cv::Scalar& bgr;
};

const std::array<Bone, 9> kBones{{
    {Joint::kPelvis, Joint::kNeck, kTrunkBgr},
    {Joint::kNeck, Joint::kHead, kTrunkBgr},
    {Joint::kLeftHip, Joint::kRightHip, kTrunkBgr},
    {Joint::kLeftHip, Joint::kLeftKnee, kLeftBgr},
    {Joint::kLeftKnee, Joint::kLeftAnkle, kLeftBgr},
    {Joint::kLeftAnkle, Joint::kLeftToe, kLeftBgr},
    {Joint::kRightHip, Joint::kRightKnee, kRightBgr},
    {Joint::kRightKnee, Joint::kRightAnkle, kRightBgr},
    {Joint::kRightAnkle, Joint::kRightToe, kRightBgr},
}};

const std::array<Bone, 5> kArmBones{{
    {Joint::kLeftShoulder, Joint::kRightShoulder, kTrunkBgr},
    {Joint::kLeftShoulder, Joint::kLeftElbow, kLeftBgr},
    {Joint::kLeftElbow, Joint::kLeftWrist, kLeftBgr},
    {Joint::kRightShoulder, Joint::kRightElbow, kRightBgr},
    {Joint::kRightElbow, Joint::kRightWrist, kRightBgr},
}};

void draw_bones(cv::Mat& image, const Camera& camera, const JointPositions& joints,
                std::span<const Bone> bones, int thickness_px) {
  for (const Bone& bone : bones) {
    if (!known(joints[bone.from]) || !known(joints[bone.to])) continue;
    draw_line(image, camera, joints[bone.from], joints[bone.to], bone.bgr, thickness_px);
  }
}

// The part of the image that contains the skeletons. Lenses bend bones beyond their joints by less
// than its margin.
cv::Rect place_of(std::span<const JointPositions> skeletons, const Camera& camera,
                  const cv::Mat& image) {
  Eigen::AlignedBox2d box;
  for (const JointPositions& joints : skeletons) {
    for (const Vector3d& joint : joints.at) {
      const auto px = known(joint) ? project(camera, joint) : std::nullopt;
      if (px) box.extend(*px);
    }
  }
  if (box.isEmpty()) return {};
  const Vector2d size(image.cols, image.rows);
  const Vector2d margin = Vector2d::Constant(4) + box.sizes() / 4;
  const Vector2d low = (box.min() - margin).cwiseMax(0).cwiseMin(size);
  const Vector2d high = (box.max() + margin).cwiseMax(0).cwiseMin(size);
  return {cv::Point(static_cast<int>(low.x()), static_cast<int>(low.y())),
          cv::Point(static_cast<int>(std::ceil(high.x())), static_cast<int>(std::ceil(high.y())))};
}

double text_scale(const cv::Mat& image) { return std::max(0.35, image.rows / 960.0); }

void draw_text(cv::Mat& image, const std::string& text, const cv::Point& at) {
  const double scale = text_scale(image);
  const int thickness = line_thickness(image);
  cv::putText(image, text, at, cv::FONT_HERSHEY_SIMPLEX, scale, cv::Scalar::all(0), 3 * thickness,
              cv::LINE_AA);
  cv::putText(image, text, at, cv::FONT_HERSHEY_SIMPLEX, scale, cv::Scalar::all(255), thickness,
              cv::LINE_AA);
}

}  // namespace

int line_thickness(const cv::Mat& image) { return std::max(1, (image.rows + 240) / 480); }

void draw_line(cv::Mat& image, const Camera& camera, const Vector3d& from, const Vector3d& to,
               const cv::Scalar& bgr, int thickness_px) {
  std::optional<Vector2d> last = project(camera, from);
  const int pieces = pieces_between(last, project(camera, to));
  for (int i = 1; i <= pieces; ++i) {
    const double share = static_cast<double>(i) / pieces;
    const std::optional<Vector2d> next = project(camera, from + share * (to - from));
    if (last && next) draw_piece(image, *last, *next, bgr, thickness_px);
    last = next;
  }
}

void draw_ground_grid(cv::Mat& image, const Camera& camera, const Vector2d& centre,
                      double half_side) {
  const double x0 = std::floor(centre.x() - half_side), x1 = std::ceil(centre.x() + half_side);
  const double y0 = std::floor(centre.y() - half_side), y1 = std::ceil(centre.y() + half_side);
  for (double x = x0; x <= x1; ++x) draw_line(image, camera, {x, y0, 0}, {x, y1, 0}, kGridBgr);
  for (double y = y0; y <= y1; ++y) draw_line(image, camera, {x0, y, 0}, {x1, y, 0}, kGridBgr);
}

void draw_axes(cv::Mat& image, const Camera& camera, const Vector3d& origin, double length) {
  const std::array<cv::Scalar, 3> colours{cv::Scalar(0, 0, 255), cv::Scalar(0, 200, 0),
                                          cv::Scalar(255, 0, 0)};
  const std::array<const char*, 3> names{"x", "y", "z"};
  for (size_t axis = 0; axis < 3; ++axis) {
    const Vector3d tip = origin + length * Vector3d::Unit(static_cast<Eigen::Index>(axis));
    draw_line(image, camera, origin, tip, colours[axis], 2 * line_thickness(image));
    const auto pixel = project(camera, tip);
    if (pixel && inside_image(camera, *pixel)) {
      draw_text(image, names[axis],
                {static_cast<int>(pixel->x()) + 3, static_cast<int>(pixel->y()) - 3});
    }
  }
}

void draw_skeleton(cv::Mat& image, const Camera& camera, const JointPositions& joints, bool arms,
                   int thickness_px) {
  draw_bones(image, camera, joints, kBones, thickness_px);
  if (arms) draw_bones(image, camera, joints, kArmBones, thickness_px);
}

void draw_spread(cv::Mat& image, const Camera& camera, std::span<const JointPositions> skeletons,
                 bool arms, double opacity) {
  const cv::Rect place = place_of(skeletons, camera, image);
  if (place.empty()) return;
  cv::Mat drawn = image(place);
  const cv::Mat plain = drawn.clone();
  for (const JointPositions& joints : skeletons) draw_skeleton(image, camera, joints, arms, 1);
  cv::addWeighted(drawn, opacity, plain, 1 - opacity, 0, drawn);
}

void draw_cross(cv::Mat& image, const Vector2d& px, const cv::Scalar& bgr, double arm_px) {
  for (const Vector2d& arm : {Vector2d(arm_px, arm_px), Vector2d(arm_px, -arm_px)})
    draw_piece(image, px - arm, px + arm, bgr, 1);
}

void draw_ring(cv::Mat& image, const Eigen::Vector2d& px, int radius_px, const cv::Scalar& bgr) {
  cv::circle(image, fixed_point(px), radius_px << kFractionBits, bgr, line_thickness(image),
             cv::LINE_AA, kFractionBits);
}

void draw_stroke(cv::Mat& image, const Eigen::Vector2d& from_px, const Eigen::Vector2d& to_px,
                 const cv::Scalar& bgr, int thickness_px) {
  cv::line(image, fixed_point(from_px), fixed_point(to_px), bgr,
           thickness_px > 0 ? thickness_px : line_thickness(image), cv::LINE_AA, kFractionBits);
}

cv::Scalar left_colour() { return kLeftBgr; }
cv::Scalar right_colour() { return kRightBgr; }
cv::Scalar trunk_colour() { return kTrunkBgr; }

void draw_caption(cv::Mat& image, const std::string& text) {
  const int margin = static_cast<int>(std::lround(16 * text_scale(image)));
  draw_text(image, text, {margin, 2 * margin + margin / 2});
}

}  // namespace io
}  // namespace walktrack
