#include "body/moved_feet.h"

#include <cmath>

#include <Eigen/Geometry>

namespace walktrack {
inline namespace body {

using Eigen::Quaterniond;
using Eigen::Vector2d;
using Eigen::Vector3d;

void turn_leg(Side side, const Vector2d& by, JointPositions& joints) {
  if (by.isZero(0)) return;
  const Vector3d& h = joints[hip(side)];
  const Vector3d from = joints[ankle(side)] - h;
  const Vector2d over_ground = from.head<2>() + by;
  const double height2 = from.squaredNorm() - over_ground.squaredNorm();
  if (!(height2 > 0)) return;  // nor NaN
  const Vector3d to(over_ground.x(), over_ground.y(), std::copysign(std::sqrt(height2), from.z()));
  const Vector3d thigh = joints[knee(side)] - h;
  joints[knee(side)] = h + Quaterniond::FromTwoVectors(from, to) * thigh;
  joints[ankle(side)] += to - from;
  joints[toe(side)] += to - from;
}

void lift_toe(Side side, JointPositions& joints) {
  const Vector3d& a = joints[ankle(side)];
  const Vector3d foot = joints[toe(side)] - a;
  const double ahead2 = foot.squaredNorm() - a.z() * a.z();
  const bool sunk = joints[toe(side)].z() < 0 && a.z() >= 0;
  if (!sunk || !(ahead2 > 0) || foot.head<2>().isZero(0)) return;
  const Vector2d ahead = std::sqrt(ahead2) * foot.head<2>().normalized();
  joints[toe(side)] = Vector3d(a.x() + ahead.x(), a.y() + ahead.y(), 0);
}

}  // namespace body
}  // namespace walktrack
