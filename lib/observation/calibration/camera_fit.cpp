#include "observation/calibration/camera_fit.h"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Geometry>
#include <opencv2/calib3d.hpp>

namespace walktrack {
inline namespace observation {

namespace {

using Eigen::Matrix3d;
using Eigen::Vector2d;
using Eigen::Vector3d;

struct Intrinsics {
  cv::Mat matrix = cv::Mat::eye(3, 3, CV_64F), distortion;
  std::vector<cv::Mat> rotations, translations;  // of the board in each view
  Vector2d focal_sd{std::nan(""), std::nan("")};
};

using CvPoints3 = std::vector<cv::Point3f>;
using CvPoints2 = std::vector<cv::Point2f>;

int brown_flags(LensModel model) {
  switch (model) {
    case LensModel::kPinhole:
      return cv::CALIB_FIX_K1 | cv::CALIB_FIX_K2 | cv::CALIB_FIX_K3 | cv::CALIB_ZERO_TANGENT_DIST;
    case LensModel::kRational:
      return cv::CALIB_RATIONAL_MODEL;
    default:
      return cv::CALIB_FIX_K3;
  }
}

void solve_polynomial(const std::vector<CvPoints3>& board, const std::vector<CvPoints2>& views,
                      cv::Size size, LensModel model, Intrinsics& out) {
  cv::Mat sd, sd_places, by_view;
  cv::calibrateCamera(board, views, size, out.matrix, out.distortion, out.rotations,
                      out.translations, sd, sd_places, by_view, brown_flags(model));
  out.focal_sd = {sd.at<double>(0), sd.at<double>(1)};
}

void solve_fisheye(const std::vector<CvPoints3>& board, const std::vector<CvPoints2>& views,
                   cv::Size size, Intrinsics& out) {
  const int flags = cv::fisheye::CALIB_RECOMPUTE_EXTRINSIC | cv::fisheye::CALIB_FIX_SKEW;
  cv::fisheye::calibrate(board, views, size, out.matrix, out.distortion, out.rotations,
                         out.translations, flags);
}

// OpenCV throws an exception if the views determine nothing.
bool solve(const std::vector<CvPoints3>& board, const std::vector<CvPoints2>& views, cv::Size size,
           LensModel model, Intrinsics& out) {
  try {
    if (model == LensModel::kFisheye) {
      solve_fisheye(board, views, size, out);
    } else {
      solve_polynomial(board, views, size, model, out);
    }
  } catch (const cv::Exception&) {
    return false;
  }
  return cv::checkRange(out.matrix) && cv::checkRange(out.distortion) &&
         out.matrix.at<double>(0, 0) > 0 && out.matrix.at<double>(1, 1) > 0;
}

void set_place(Camera& camera, const cv::Mat& rotation, const cv::Mat& translation) {
  const cv::Mat turn = rotation.reshape(1, 3), shift = translation.reshape(1, 3);
  const Vector3d r(turn.at<double>(0), turn.at<double>(1), turn.at<double>(2));
  camera.rotation = r.norm() > 0 ? Eigen::AngleAxisd(r.norm(), r.normalized()).toRotationMatrix()
                                 : Matrix3d::Identity();
  camera.translation = {shift.at<double>(0), shift.at<double>(1), shift.at<double>(2)};
}

Camera lens_of(const Intrinsics& found, cv::Size size, LensModel model) {
  Camera camera;
  camera.width_px = size.width;
  camera.height_px = size.height;
  camera.focal_px = {found.matrix.at<double>(0, 0), found.matrix.at<double>(1, 1)};
  camera.centre_px = {found.matrix.at<double>(0, 2), found.matrix.at<double>(1, 2)};
  const cv::Mat flat = found.distortion.reshape(1, 1);
  // calibrateCamera returns up to 14 coefficients; those beyond the model are zero.
  const int most = model == LensModel::kRational ? 8 : model == LensModel::kFisheye ? 4 : 5;
  const std::vector<double> numbers(flat.ptr<double>(),
                                    flat.ptr<double>() + std::min(most, flat.cols));
  set_distortion(camera, numbers, model == LensModel::kFisheye);
  return camera;
}

PixelPoints misses_of(const Camera& camera, const PixelPoints& pixels,
                      const std::vector<Vector3d>& world) {
  PixelPoints out;
  for (size_t i = 0; i < pixels.size(); ++i) {
    const auto seen = project(camera, world[i]);
    out.emplace_back(Vector2d::Constant(std::nan("")));
    if (seen) out.back() = pixels[i] - *seen;
  }
  return out;
}

double rms_of(const std::vector<PixelPoints>& misses) {
  double sum = 0;
  size_t count = 0;
  for (const PixelPoints& view : misses) {
    for (const Vector2d& miss : view) {
      if (!miss.allFinite()) return std::numeric_limits<double>::infinity();
      sum += miss.squaredNorm();
      ++count;
    }
  }
  return std::sqrt(sum / static_cast<double>(count));
}

double largest_angle(const std::vector<Vector3d>& normals) {
  double cosine = 1;
  for (const Vector3d& a : normals)
    for (const Vector3d& b : normals) cosine = std::min(cosine, a.dot(b));
  return std::acos(std::max(cosine, -1.0));
}

CvPoints3 cv_points(const std::vector<Vector3d>& points) {
  CvPoints3 out;
  for (const Vector3d& p : points)
    out.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()),
                     static_cast<float>(p.z()));
  return out;
}

CvPoints2 cv_points(const PixelPoints& points) {
  CvPoints2 out;
  for (const Vector2d& p : points)
    out.emplace_back(static_cast<float>(p.x()), static_cast<float>(p.y()));
  return out;
}

}  // namespace

std::optional<LensFit> fit_lens(const Board& board, const std::vector<PixelPoints>& views,
                                int width_px, int height_px, LensModel model) {
  const cv::Size size(width_px, height_px);
  const std::vector<Vector3d> points = board_points(board);
  std::vector<CvPoints2> seen;
  for (const PixelPoints& view : views) seen.push_back(cv_points(view));
  Intrinsics found;
  if (!solve(std::vector<CvPoints3>(views.size(), cv_points(points)), seen, size, model, found))
    return std::nullopt;
  LensFit out;
  out.camera = lens_of(found, size, model);
  out.focal_sd_px = found.focal_sd;
  std::vector<Vector3d> normals;
  for (size_t i = 0; i < views.size(); ++i) {
    set_place(out.camera, found.rotations[i], found.translations[i]);
    out.misses.push_back(misses_of(out.camera, views[i], points));
    normals.push_back(out.camera.rotation.col(2));
  }
  out.rms_px = rms_of(out.misses);
  out.boards_apart = largest_angle(normals);
  return out;
}

std::optional<PlaceFit> fit_place(const Camera& lens, const PixelPoints& pixels,
                                  const std::vector<Vector3d>& world) {
  std::vector<cv::Point2d> flat;
  std::vector<cv::Point3d> points;
  for (size_t i = 0; i < pixels.size(); ++i) {
    const auto ray = undistort(lens, (pixels[i] - lens.centre_px).cwiseQuotient(lens.focal_px));
    if (!ray) return std::nullopt;
    flat.emplace_back(ray->x(), ray->y());
    points.emplace_back(world[i].x(), world[i].y(), world[i].z());
  }
  const cv::Mat eye = cv::Mat::eye(3, 3, CV_64F);
  cv::Mat rotation, translation;
  try {
    if (!cv::solvePnP(points, flat, eye, cv::noArray(), rotation, translation, false,
                      cv::SOLVEPNP_SQPNP))
      return std::nullopt;
    cv::solvePnPRefineLM(points, flat, eye, cv::noArray(), rotation, translation);
  } catch (const cv::Exception&) {  // points that determine nothing
    return std::nullopt;
  }
  PlaceFit out{lens, {}, 0};
  set_place(out.camera, rotation, translation);
  if (!out.camera.rotation.allFinite() || !out.camera.translation.allFinite()) return std::nullopt;
  out.misses = misses_of(out.camera, pixels, world);
  out.rms_px = rms_of({out.misses});
  return out;
}

}  // namespace observation
}  // namespace walktrack
