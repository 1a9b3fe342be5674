#include "observation/keypoints/keypoint_points.h"

#include <algorithm>
#include <cmath>

namespace walktrack {
inline namespace observation {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// Least confidence of a point that is used: MoveNet's authors draw points from .11 on, OpenPose's
// from .05.
constexpr double kLeastConfidence = 0.1;
// Far outside every image, and still far from overflow.
constexpr double kNowhere = 1e6;
constexpr float kFarthest = 1e6F;

constexpr size_t index(PointKind kind, Side side) {
  return 2 * static_cast<size_t>(kind) - 1 + static_cast<size_t>(side);
}

struct Sided {
  PointKind kind;
  KeypointName left, right;
};
constexpr std::array kSided{
    Sided{PointKind::kShoulder, KeypointName::kLeftShoulder, KeypointName::kRightShoulder},
    Sided{PointKind::kElbow, KeypointName::kLeftElbow, KeypointName::kRightElbow},
    Sided{PointKind::kWrist, KeypointName::kLeftWrist, KeypointName::kRightWrist},
    Sided{PointKind::kHip, KeypointName::kLeftHip, KeypointName::kRightHip},
    Sided{PointKind::kKnee, KeypointName::kLeftKnee, KeypointName::kRightKnee},
    Sided{PointKind::kAnkle, KeypointName::kLeftAnkle, KeypointName::kRightAnkle},
    Sided{PointKind::kToe, KeypointName::kLeftBigToe, KeypointName::kRightBigToe},
    Sided{PointKind::kHeel, KeypointName::kLeftHeel, KeypointName::kRightHeel}};
constexpr std::array kFace{KeypointName::kNose, KeypointName::kLeftEye, KeypointName::kRightEye,
                           KeypointName::kLeftEar, KeypointName::kRightEar};

double confidence_of(const Keypoint& point) {
  const bool sound = std::abs(point.x_px) < kFarthest && std::abs(point.y_px) < kFarthest;
  const auto confidence = static_cast<double>(point.confidence);
  return sound && confidence >= kLeastConfidence ? std::min(1.0, confidence) : 0;
}

Vector2d shrunk_pixel(const Keypoint& point, int shrink) {
  const Vector2d px(static_cast<double>(point.x_px), static_cast<double>(point.y_px));
  return (px.array() + 0.5) / shrink - 0.5;
}

// Face and ears are around the centre of the head.
void add_head(const DetectedPerson& person, int shrink, SeenPoints& out) {
  double sum = 0, most = 0;
  Vector2d mean = Vector2d::Zero();
  for (const KeypointName name : kFace) {
    const double confidence = confidence_of(person[name]);
    if (confidence == 0) continue;
    mean += confidence * shrunk_pixel(person[name], shrink);
    sum += confidence;
    most = std::max(most, confidence);
  }
  out.confidence[0] = most;
  out.px[0] = sum > 0 ? Vector2d(mean / sum) : mean;
}

void add(const Keypoint& point, int shrink, size_t i, SeenPoints& out) {
  out.confidence[i] = confidence_of(point);
  out.px[i] = out.confidence[i] > 0 ? shrunk_pixel(point, shrink) : Vector2d::Zero();
}

// Distances from the head's centre to the ankles are .89 of the height, from shoulders to hips .29
// (subject.h). The first is shorter for a subject who is partly hidden or bends forward.
double height_px(const SeenPoints& points) {
  Vector2d low = Vector2d::Constant(1e9), high = -low;
  for (size_t i = 0; i < kBodyPoints; ++i) {
    if (points.confidence[i] == 0) continue;
    low = low.cwiseMin(points.px[i]);
    high = high.cwiseMax(points.px[i]);
  }
  double height = high.x() >= low.x() ? (high - low).norm() / 0.89 : 0;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const size_t shoulder = index(PointKind::kShoulder, side), hip = index(PointKind::kHip, side);
    if (points.confidence[shoulder] > 0 && points.confidence[hip] > 0)
      height = std::max(height, (points.px[shoulder] - points.px[hip]).norm() / 0.29);
  }
  return height;
}

Segment limb_of(size_t point) {
  const bool left = point % 2 == 1;
  switch (kind_of(point)) {
    case PointKind::kHead:
    case PointKind::kShoulder:
      return Segment::kTrunk;
    case PointKind::kElbow:
      return left ? Segment::kLeftUpperArm : Segment::kRightUpperArm;
    case PointKind::kWrist:
      return left ? Segment::kLeftForearm : Segment::kRightForearm;
    case PointKind::kHip:
      return Segment::kPelvis;
    case PointKind::kKnee:
      return left ? Segment::kLeftThigh : Segment::kRightThigh;
    case PointKind::kAnkle:
      return left ? Segment::kLeftShank : Segment::kRightShank;
    case PointKind::kToe:
    case PointKind::kHeel:
      return left ? Segment::kLeftFoot : Segment::kRightFoot;
  }
  return Segment::kPelvis;
}

// The body model's own point, without an offset.
Vector3d body_point(const PosedBody& body, size_t point) {
  const Skeleton& s = body.skeleton;
  const BodyLengths& l = body.body->lengths;
  const Side side = point % 2 == 1 ? Side::kLeft : Side::kRight;
  const bool left = side == Side::kLeft;
  const auto shoulder = [&]() -> Vector3d {
    return s.joints[Joint::kPelvis] +
           s.axes(Segment::kTrunk) * Vector3d(0, (left ? 0.5 : -0.5) * l.shoulder_width, l.trunk);
  };
  switch (kind_of(point)) {
    case PointKind::kHead:
      return s.joints[Joint::kHead];
    case PointKind::kShoulder:
      return shoulder();
    case PointKind::kElbow:
      return s.joints[left ? Joint::kLeftElbow : Joint::kRightElbow];
    case PointKind::kWrist:
      return s.joints[left ? Joint::kLeftWrist : Joint::kRightWrist];
    case PointKind::kHip:
      return s.joints[hip(side)];
    case PointKind::kKnee:
      return s.joints[knee(side)];
    case PointKind::kAnkle:
      return s.joints[ankle(side)];
    case PointKind::kToe:  // its tip; a foot extends .77 of its length in front of the ankle
                           // (body.cpp)
      return s.joints[ankle(side)] +
             s.axes(limb_of(point)) * Vector3d(.77 * l.foot, 0, l.ball_height - l.ankle_height);
    case PointKind::kHeel:
      return s.joints[ankle(side)] +
             s.axes(limb_of(point)) * Vector3d(-.23 * l.foot, 0, -.7 * l.ankle_height);
  }
  return {};
}

Vector3d seen_point(const PosedBody& body, size_t point, const Vector2d& offset) {
  const Eigen::Matrix3d& axes = body.skeleton.axes(limb_of(point));
  return body_point(body, point) +
         body.body->subject.height * (offset.x() * axes.col(0) + offset.y() * axes.col(2));
}

bool has(const PosedBody& body, size_t point) {
  return body.body->groups.arms || !needs_arms(kind_of(point));
}

}  // namespace

SeenPoints seen_points(const DetectedPerson& person, int shrink, bool arms) {
  SeenPoints out;
  out.confidence.fill(0);
  out.px.fill(Vector2d::Zero());
  add_head(person, shrink, out);
  for (const Sided& each : kSided) {
    if (needs_arms(each.kind) && !arms) continue;
    add(person[each.left], shrink, index(each.kind, Side::kLeft), out);
    add(person[each.right], shrink, index(each.kind, Side::kRight), out);
  }
  out.height_px = height_px(out);
  return out;
}

PointPixels point_pixels(const Camera& camera, const PosedBody& body, const PointOffsets& offsets) {
  PointPixels out;
  for (size_t i = 0; i < kBodyPoints; ++i) {
    out[i] = Vector2d::Constant(kNowhere);
    if (!has(body, i)) continue;
    const Vector2d& offset = offsets[static_cast<size_t>(kind_of(i))];
    const auto px = project(camera, seen_point(body, i, offset));
    // A lens model is not valid for points far outside the image.
    if (px && px->cwiseAbs().maxCoeff() < kNowhere) out[i] = *px;
  }
  return out;
}

Eigen::Matrix2d pixel_per_offset(const Camera& camera, const PosedBody& body, size_t point,
                                 const PointOffsets& offsets) {
  constexpr double kStep = 0.005;  // share of the height, about a centimetre
  const Vector2d& offset = offsets[static_cast<size_t>(kind_of(point))];
  Eigen::Matrix2d out = Eigen::Matrix2d::Zero();
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    const Vector2d step = kStep * Vector2d::Unit(axis);
    const auto ahead = project(camera, seen_point(body, point, offset + step));
    const auto behind = project(camera, seen_point(body, point, offset - step));
    if (ahead && behind) out.col(axis) = (*ahead - *behind) / (2 * kStep);
  }
  return out;
}

}  // namespace observation
}  // namespace walktrack
