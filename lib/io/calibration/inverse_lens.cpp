#include "io/calibration/inverse_lens.h"

#include <algorithm>
#include <vector>

#include <fmt/format.h>

#include "core/dense.h"

namespace walktrack {
inline namespace io {

namespace {

using Eigen::Vector2d;

constexpr int kAcross = 24;  // samples along each side of the image

}  // namespace

void set_inverse_distortion(Camera& camera,
                            const std::function<Vector2d(const Vector2d&)>& straight,
                            const char* key, const Complain& complain) {
  std::vector<Vector2d> pixels, ideal;
  for (int row = 0; row <= kAcross; ++row)
    for (int column = 0; column <= kAcross; ++column) {
      pixels.emplace_back((camera.width_px - 1.0) * column / kAcross,
                          (camera.height_px - 1.0) * row / kAcross);
      ideal.push_back((straight(pixels.back()) - camera.centre_px).cwiseQuotient(camera.focal_px));
      if (!ideal.back().allFinite()) complain(key, "a lens without end", "smaller coefficients");
    }
  const auto count = static_cast<Eigen::Index>(pixels.size());
  Eigen::Matrix<double, Eigen::Dynamic, 5> terms(2 * count, 5);
  Eigen::VectorXd bent(2 * count);
  for (Eigen::Index i = 0; i < count; ++i) {
    const Vector2d& at = ideal[static_cast<size_t>(i)];
    const double x = at.x(), y = at.y(), r2 = at.squaredNorm();
    terms.row(2 * i) << x * r2, x * r2 * r2, 2 * x * y, r2 + 2 * x * x, x * r2 * r2 * r2;
    terms.row(2 * i + 1) << y * r2, y * r2 * r2, r2 + 2 * y * y, 2 * x * y, y * r2 * r2 * r2;
    bent.segment<2>(2 * i) =
        (pixels[static_cast<size_t>(i)] - camera.centre_px).cwiseQuotient(camera.focal_px) - at;
  }
  const Eigen::Vector<double, 5> k = least_squares(terms, bent);
  const Eigen::VectorXd missed = terms * k - bent;
  double worst = 0;
  for (Eigen::Index i = 0; i < count; ++i)
    worst = std::max(worst, missed.segment<2>(2 * i).cwiseProduct(camera.focal_px).norm());
  if (!(worst <= kMostLensMisfit) || !k.allFinite())
    complain(key, fmt::format("a lens that k1 k2 p1 p2 k3 describe only to {:.2g} px", worst),
             fmt::format("at most {:g} px", kMostLensMisfit));
  set_distortion(camera, std::vector<double>(k.data(), k.data() + 5));
}

}  // namespace io
}  // namespace walktrack
