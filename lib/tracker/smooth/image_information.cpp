#include "tracker/smooth/image_information.h"

#include <algorithm>
#include <array>

#include "core/dense.h"

namespace walktrack {
inline namespace tracker {

namespace {

constexpr size_t kCount = kPoseNumbers.size();

// Where (i, j) is in a lower triangle.
size_t place(size_t i, size_t j) {
  const auto [low, high] = std::minmax(i, j);
  return high * (high + 1) / 2 + low;
}

// The place of a number's counterpart on the other side, and the sign that it changes by: legs that
// reach to each other's feet abduct the other way.
struct Mirrored {
  size_t place;
  double sign;
};

Mirrored mirrored(size_t i) {
  const PoseNumber& number = kPoseNumbers[i];
  if (number.limb() == Limb::kTrunk) return {i, 1};
  const auto other = std::ranges::find_if(kPoseNumbers, [&](const PoseNumber& each) {
    return each.limb() == number.limb() && each.leg == number.leg && each.arm == number.arm &&
           each.side != number.side;
  });
  return {static_cast<size_t>(other - kPoseNumbers.begin()),
          number.leg == &LegPose::hip_abduction ? -1.0 : 1.0};
}

}  // namespace

std::vector<double> packed(const FreeNumbers& free, const Eigen::MatrixXd& information) {
  std::vector<double> out(kCount * (kCount + 1) / 2, 0.0);
  for (size_t a = 0; a < free.size(); ++a)
    for (size_t b = 0; b <= a; ++b)
      out[place(free[a], free[b])] =
          information(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b));
  return out;
}

Eigen::MatrixXd unpacked(const FreeNumbers& free, const ImageInformation& images) {
  const auto size = static_cast<Eigen::Index>(free.size());
  Eigen::MatrixXd out(size, size);
  for (size_t a = 0; a < free.size(); ++a)
    for (size_t b = 0; b < free.size(); ++b)
      out(static_cast<Eigen::Index>(a), static_cast<Eigen::Index>(b)) =
          images.information[place(free[a], free[b])];
  return out;
}

// The gradient of the sum and that of the walker's prior P cancel at the new pose: with images H
// about x and the evidence G about y, (H + P + G) d = G (y - x) from x.
void add_information(const FreeNumbers& free, const Pose& pose, const Eigen::MatrixXd& information,
                     ImageInformation& images) {
  if (images.information.empty()) {
    images.pose = pose;
    images.walker = pose;
    images.information = packed(free, information);
    return;
  }
  const Eigen::MatrixXd sum = unpacked(free, images) + information;
  const Eigen::VectorXd precision = spreads_of(free).cwiseInverse().cwiseAbs2();
  const Eigen::MatrixXd posterior = sum + Eigen::MatrixXd(precision.asDiagonal());
  const Eigen::VectorXd step =
      solve_positive(posterior, information * difference(free, images.pose, pose));
  images.pose = with_values(free, images.pose, values_of(free, images.pose) + step);
  images.information = packed(free, sum);
}

void mirror_information(ImageInformation& images) {
  if (images.information.empty()) return;
  const std::vector<double> before = images.information;
  for (size_t i = 0; i < kCount; ++i) {
    for (size_t j = 0; j <= i; ++j) {
      const Mirrored a = mirrored(i), b = mirrored(j);
      images.information[place(i, j)] = a.sign * b.sign * before[place(a.place, b.place)];
    }
  }
}

}  // namespace tracker
}  // namespace walktrack
