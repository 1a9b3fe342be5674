#include "tracker/smooth/planting.h"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>
#include <Eigen/SparseCholesky>

#include "body/moved_feet.h"
#include "body/pose_from_joints.h"
#include "body/pose_numbers.h"
#include "core/conventions.h"

namespace walktrack {
inline namespace tracker {

namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;

// s, over which a shift fades: shorter ones tremble, longer ones move the swinging foot.
// By hand.
constexpr double kFade = 0.04;
// Against the unit weight of a shift: feet may still slide 2 to 5 % of what they did. By hand.
constexpr double kStands = 50;

Vector2d foot_on_ground(const JointPositions& joints, Side side) {
  return 0.5 * (joints[ankle(side)] + joints[toe(side)]).head<2>();
}

bool stands(const Motion& motion, const FlatFoot& flat) {
  if (flat.last >= motion.joints.size() || flat.first >= flat.last) return false;
  Eigen::AlignedBox2d box;
  for (size_t i = flat.first; i <= flat.last; ++i) {
    const Vector2d foot = foot_on_ground(motion.joints[i], flat.side);
    if (!foot.allFinite()) return false;
    box.extend(foot);
  }
  return box.diagonal().norm() <= kTooFarToStand;
}

// The normal equations of the header's sum for one foot; unknowns: a shift for each row, then a
// place for each stretch. Both coordinates have the same matrix.
class Planting {
 public:
  Planting(const Motion& motion, Side side, size_t stretches)
      : motion_(motion), side_(side), rows_(motion.joints.size()) {
    const auto size = static_cast<Eigen::Index>(rows_ + stretches);
    right_ = Eigen::MatrixX2d::Zero(size, 2);
    const double dt = sample_period(motion);
    const double bend = std::pow(kFade / dt, 4);
    for (size_t i = 0; i < rows_; ++i) add(i, i, 1);
    for (size_t i = 1; i + 1 < rows_; ++i) {
      if (!knows(i - 1) || !knows(i) || !knows(i + 1)) continue;
      constexpr std::array kSecondDifference{1.0, -2.0, 1.0};
      for (size_t a = 0; a < 3; ++a)
        for (size_t b = 0; b < 3; ++b)
          add(i + a - 1, i + b - 1, bend * kSecondDifference[a] * kSecondDifference[b]);
    }
  }

  // Stretch number `place`.
  void stand(const FlatFoot& flat, size_t place) {
    const size_t p = rows_ + place;
    for (size_t i = flat.first; i <= flat.last; ++i) {
      const Vector2d foot = foot_on_ground(motion_.joints[i], side_);
      add(i, i, kStands);
      add(p, p, kStands);
      add(i, p, -kStands);
      add(p, i, -kStands);
      right_.row(static_cast<Eigen::Index>(i)) -= kStands * foot.transpose();
      right_.row(static_cast<Eigen::Index>(p)) += kStands * foot.transpose();
    }
  }

  Eigen::MatrixX2d shifts() const {
    Eigen::SparseMatrix<double> matrix(right_.rows(), right_.rows());
    matrix.setFromTriplets(terms_.begin(), terms_.end());
    return Eigen::SimplicialLDLT<Eigen::SparseMatrix<double>>(matrix).solve(right_).topRows(
        static_cast<Eigen::Index>(rows_));
  }

 private:
  bool knows(size_t i) const { return foot_on_ground(motion_.joints[i], side_).allFinite(); }
  void add(size_t row, size_t column, double value) {
    terms_.emplace_back(static_cast<int>(row), static_cast<int>(column), value);
  }

  const Motion& motion_;
  Side side_;
  size_t rows_;
  std::vector<Eigen::Triplet<double>> terms_;
  Eigen::MatrixX2d right_;
};

void move_feet(const FootShifts& by, JointPositions& joints) {
  for (const Side side : {Side::kLeft, Side::kRight}) {
    turn_leg(side, by[static_cast<size_t>(side)], joints);
    lift_toe(side, joints);
  }
}

// The pose's legs turn as the mean joints' do, which are not quite the pose's own.
void turn_legs(const JointPositions& from, const JointPositions& to, Pose& pose) {
  const BodyLengths lengths{};  // ankles differ by the same, whatever is neutral
  const auto was = pose_from_joints(from, lengths), is = pose_from_joints(to, lengths);
  if (!was || !is) return;
  for (const PoseNumber& number : kPoseNumbers)
    if (number.limb() == Limb::kLeg)
      number.in(pose) += std::remainder(number.in(*is) - number.in(*was), 2 * kPi);
}

}  // namespace

std::vector<FootShifts> planting_shifts(const Motion& motion, std::span<const FlatFoot> flat) {
  std::vector<FootShifts> out(motion.joints.size(), {Vector2d::Zero(), Vector2d::Zero()});
  for (const Side side : {Side::kLeft, Side::kRight}) {
    std::vector<FlatFoot> standing;
    for (const FlatFoot& each : flat)
      if (each.side == side && stands(motion, each)) standing.push_back(each);
    if (standing.empty()) continue;
    Planting planting(motion, side, standing.size());
    for (size_t k = 0; k < standing.size(); ++k) planting.stand(standing[k], k);
    const Eigen::MatrixX2d shifts = planting.shifts();
    for (size_t i = 0; i < out.size(); ++i)
      out[i][static_cast<size_t>(side)] = shifts.row(static_cast<Eigen::Index>(i));
  }
  return out;
}

void plant_feet(const FootShifts& by, FrameRecord& record) {
  if (!record.tracked) return;
  const FrameEstimate before = record.estimate;
  move_feet(by, record.estimate.joints);
  turn_legs(before.joints, record.estimate.joints, record.estimate.pose);
  shift_bands(before, record.estimate);
  for (JointPositions& sample : record.samples) move_feet(by, sample);
}

}  // namespace tracker
}  // namespace walktrack
