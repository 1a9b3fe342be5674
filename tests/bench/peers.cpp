#include "tests/bench/peers.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <vector>

namespace walktrack {

TmtWalker::TmtWalker(const KneedModel& model)
    : centres(part_centres(model.parameters)),
      masses(walktrack::part_masses(model.parameters)),
      gravity(model.gravity),
      foot_radius(model.parameters.foot_radius) {
  const auto inertias = part_inertias(model.parameters);
  for (size_t i = 0; i < 5; ++i)
    part_masses.segment<3>(3 * static_cast<Eigen::Index>(i)) << masses[i], masses[i], inertias[i];
}

Vector5 TmtWalker::accelerations(const KneedControls& controls, const KneedState& state) const {
  const KneedTrig trig(state.q);
  const Vector5 square = state.qd.cwiseProduct(state.qd);
  Eigen::Matrix<double, 15, 5> t = Eigen::Matrix<double, 15, 5>::Zero();
  Eigen::Matrix<double, 15, 1> force = Eigen::Matrix<double, 15, 1>::Zero();
  for (int i = 0; i < 5; ++i) {
    const KneedPoint& c = centres[static_cast<size_t>(i)];
    t.block<2, 5>(3 * i, 0) = point_jacobian(c, trig, foot_radius);
    t(3 * i + 2, i) = 1;
    // d/dt (dp/dq_k) qd_k = -(along_k u(q_k) + across_k w(q_k)) qd_k^2
    const Vector2 convective(
        -(c.along.cwiseProduct(trig.sine) + c.across.cwiseProduct(trig.cosine)).dot(square),
        -(c.along.cwiseProduct(trig.cosine) - c.across.cwiseProduct(trig.sine)).dot(square));
    force.segment<2>(3 * i) = masses[static_cast<size_t>(i)] * (gravity - convective);
  }
  const Matrix5 reduced = t.transpose() * part_masses.asDiagonal() * t;
  return reduced.llt().solve(t.transpose() * force + kneed_torques(controls, state.q, state.qd));
}

double per_pixel_silhouette(const LogRatioPlanes& planes, const CapsuleList& capsules) {
  const PixelRect& area = planes.area;
  std::vector<bool> taken(static_cast<size_t>(area.width()) * static_cast<size_t>(area.height()));
  int64_t sum = 0;
  for (const Capsule& c : capsules) {
    const Disc &a = c.lower, &b = c.upper;
    const Eigen::Vector2d least =
        (a.centre.array() - a.radius).min(b.centre.array() - b.radius).matrix();
    const Eigen::Vector2d most =
        (a.centre.array() + a.radius).max(b.centre.array() + b.radius).matrix();
    const int x0 = std::max(area.x0, static_cast<int>(std::ceil(least.x())));
    const int x1 = std::min(area.x1, static_cast<int>(std::floor(most.x())) + 1);
    const int y0 = std::max(area.y0, static_cast<int>(std::ceil(least.y())));
    const int y1 = std::min(area.y1, static_cast<int>(std::floor(most.y())) + 1);
    const int plane = planes.plane_of[static_cast<size_t>(c.appearance)];
    for (int y = y0; y < y1; ++y) {
      const auto row = planes.row(plane, y);
      for (int x = x0; x < x1; ++x) {
        const auto at = static_cast<size_t>((y - area.y0) * area.width() + x - area.x0);
        if (taken[at] || !inside(c, Eigen::Vector2d(x, y))) continue;
        taken[at] = true;
        const auto column = static_cast<size_t>(x - area.x0);
        sum += row[column + 1] - row[column];
      }
    }
  }
  return static_cast<double>(sum) / LogRatioPlanes::kNat;
}

}  // namespace walktrack
