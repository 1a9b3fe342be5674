#include "tracker/smooth/trajectory.h"

#include <array>
#include <cmath>
#include <utility>

#include "body/kinematics.h"
#include "core/conventions.h"
#include "core/rng.h"
#include "tracker/smooth/normal_equations.h"
#include "tracker/state/free_numbers.h"

namespace walktrack {
inline namespace tracker {

namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::Vector2d;
using Eigen::VectorXd;

// Constants of the header's sum. By hand, chosen on the videos of tracker/reports/reported_pose.md:
// halved and doubled, the errors of rendered walks change by less than 2 %, and those of the two
// telephones by up to 15 %.
constexpr double kWalkerRate = 1.5;          // w / dt, 1/s
constexpr double kImageTime = 1.0 / 30;      // s, for which images err alike
constexpr double kAccelerationTime = 0.025;  // tau, s
constexpr double kSway = 0.5;                // m/s^2, of the root, across the walk
constexpr double kSlide = 0.001;             // c, m
constexpr double kSole = 0.03;               // b, m, once every
constexpr double kSoleTime = 0.1;            // s
constexpr int kNewtonSteps = 3;
constexpr double kDifference = 1e-5;  // of central differences
constexpr double kFixed = 1e12;       // information of a pose that is not to change

// Ankle and toe of the left foot, then of the right one.
using FeetPoints = Eigen::Matrix<double, 12, 1>;
constexpr Index kFootSize = 6, kPointSize = 3;

FeetPoints feet_points(const Body& body, const Pose& pose) {
  const JointPositions joints = forward_kinematics(body, pose).joints;
  FeetPoints out;
  out << joints[Joint::kLeftAnkle], joints[Joint::kLeftToe], joints[Joint::kRightAnkle],
      joints[Joint::kRightToe];
  return out;
}

Index first_row(Side side) { return side == Side::kLeft ? 0 : kFootSize; }

class Trajectory {
 public:
  Trajectory(const BodyModel& model, const TrajectoryFrames& frames)
      : body_(model.body),
        free_(free_numbers(model)),
        dt_(frames.dt),
        records_(frames.records),
        flat_(frames.flat),
        settled_(frames.settled),
        ways_(frames.ways),
        spreads_(spreads_of(free_)) {
    for (const FrameRecord& record : records_) poses_.push_back(record.estimate.pose);
    for (const FlatFoot& each : flat_) places_.push_back(mean_place(each));
  }

  void improve() {
    const NormalEquations sum = this->sum();
    const VectorXd step = Factor(sum.matrix()).solve(sum.right());
    for (size_t t = 0; t < poses_.size(); ++t) poses_[t] = moved(t, step);
    for (size_t k = 0; k < places_.size(); ++k) places_[k] += step.segment<2>(place_of(k));
  }

  std::vector<Poses> draws(const WantedDraws& wanted) const {
    const Factor factor(sum().matrix());
    std::vector<Poses> out;
    for (const Poses& settled : wanted.settled) {
      Rng rng(wanted.seed, Purpose::kTrajectory, wanted.part, static_cast<uint32_t>(out.size()));
      const VectorXd aside = drawn(factor, rng) + factor.solve(pull_to(settled));
      Poses& draw = out.emplace_back(settled);
      for (size_t t = settled_; t < poses_.size(); ++t) draw.push_back(moved(t, aside));
    }
    return out;
  }

  const Poses& poses() const { return poses_; }

 private:
  NormalEquations sum() const {
    NormalEquations sum(place_of(flat_.size()));
    for (size_t t = 0; t < poses_.size(); ++t) {
      if (t < settled_) fix(t, sum);
      add_images(t, sum);
      add_walker(t, sum);
      if (t > 0 && t + 1 < poses_.size()) add_acceleration(t, sum);
      add_sunken_toes(t, sum);
      add_legs_aside(t, sum);
    }
    for (size_t k = 0; k < flat_.size(); ++k) add_flat(k, sum);
    return sum;
  }

  WalkingDirection way(size_t t) const { return ways_.empty() ? std::nullopt : ways_[t]; }

  Index numbers() const { return static_cast<Index>(free_.size()); }
  Index at(size_t frame) const { return static_cast<Index>(frame) * numbers(); }
  Index place_of(size_t stretch) const {
    return at(poses_.size()) + 2 * static_cast<Index>(stretch);
  }

  Vector2d mean_place(const FlatFoot& flat) const {
    Vector2d sum = Vector2d::Zero();
    for (size_t t = flat.first; t <= flat.last; ++t) {
      const FeetPoints points = feet_points(body_, poses_[t]);
      const Index row = first_row(flat.side);
      sum += 0.5 * (points.segment<2>(row) + points.segment<2>(row + kPointSize));
    }
    return sum / static_cast<double>(flat.last - flat.first + 1);
  }

  Pose moved(size_t t, const VectorXd& by) const {
    return with_values(free_, poses_[t],
                       values_of(free_, poses_[t]) + by.segment(at(t), numbers()));
  }

  // What draws the settled frames, which are fixed, to other poses.
  VectorXd pull_to(const Poses& settled) const {
    VectorXd out = VectorXd::Zero(place_of(flat_.size()));
    for (size_t t = 0; t < settled_; ++t)
      out.segment(at(t), numbers()) = kFixed * difference(free_, poses_[t], settled[t]);
    return out;
  }

  void fix(size_t t, NormalEquations& sum) const {
    for (Index k = 0; k < numbers(); ++k) sum.add(at(t) + k, at(t) + k, kFixed);
  }

  // A frame whose images give no evidence counts as known to the deviations of people from walkers.
  void add_images(size_t t, NormalEquations& sum) const {
    const ImageInformation& images = records_[t].images;
    const bool asked = !images.information.empty();
    const Pose& best = asked ? images.pose : records_[t].estimate.pose;
    const VectorXd off = difference(free_, best, poses_[t]);
    const VectorXd precision = spreads_.cwiseInverse().cwiseAbs2();
    const MatrixXd information = asked ? unpacked(free_, images) : MatrixXd(precision.asDiagonal());
    VectorXd pull = -information * off;
    if (asked) pull += precision.cwiseProduct(difference(free_, images.walker, best));
    const double weight = std::min(1.0, dt_ / kImageTime);
    for (Index i = 0; i < numbers(); ++i) {
      sum.pull(at(t) + i, weight * pull[i]);
      for (Index j = 0; j <= i; ++j) sum.add(at(t) + i, at(t) + j, weight * information(i, j));
    }
  }

  void add_walker(size_t t, NormalEquations& sum) const {
    const ImageInformation& images = records_[t].images;
    if (images.information.empty()) return;
    const VectorXd off = difference(free_, images.walker, poses_[t]);
    for (Index k = kOverGround; k < numbers(); ++k)
      sum.add(
          SquareTerm{off[k], kWalkerRate * dt_ / (spreads_[k] * spreads_[k]), {{at(t) + k, 1.0}}});
  }

  // Of the second difference of a number whose acceleration has that root mean square.
  double acceleration_weight(double rms) const {
    return 1 / (4.0 / 3 * rms * rms * kAccelerationTime * dt_ * dt_ * dt_);
  }

  void add_acceleration(size_t t, NormalEquations& sum) const {
    const VectorXd change =
        difference(free_, poses_[t], poses_[t + 1]) - difference(free_, poses_[t - 1], poses_[t]);
    const auto rms = [&](Index k) {
      return kPoseNumbers[free_[static_cast<size_t>(k)]].acceleration;
    };
    const WalkingDirection way = this->way(t);
    const Vector2d ahead = way.value_or(Vector2d::UnitX()), aside(-ahead.y(), ahead.x());
    const Vector2d over_ground = change.head<kOverGround>();
    for (const auto& [axis, acceleration] :
         {std::pair{ahead, rms(0)}, {aside, way ? kSway : rms(1)}}) {
      SquareTerm term{axis.dot(over_ground), acceleration_weight(acceleration), {}};
      for (const auto& [frame, factor] : {std::pair{t - 1, 1.0}, {t, -2.0}, {t + 1, 1.0}})
        for (Index k = 0; k < kOverGround; ++k)
          term.slope.emplace_back(at(frame) + k, factor * axis[k]);
      sum.add(term);
    }
    for (Index k = kOverGround; k < numbers(); ++k)
      sum.add(SquareTerm{change[k],
                         acceleration_weight(rms(k)),
                         {{at(t - 1) + k, 1.0}, {at(t) + k, -2.0}, {at(t + 1) + k, 1.0}}});
  }

  // Of a function of the frame's pose: by row of its value and free number.
  template <typename Function>
  MatrixXd slopes(size_t t, const Function& of) const {
    const VectorXd values = values_of(free_, poses_[t]);
    MatrixXd out(of(poses_[t]).size(), numbers());
    for (Index k = 0; k < numbers(); ++k) {
      const VectorXd aside = kDifference * VectorXd::Unit(numbers(), k);
      out.col(k) = (of(with_values(free_, poses_[t], values + aside)) -
                    of(with_values(free_, poses_[t], values - aside))) /
                   (2 * kDifference);
    }
    return out;
  }
  MatrixXd feet_slopes(size_t t) const {
    return slopes(t, [&](const Pose& pose) { return feet_points(body_, pose); });
  }

  std::vector<std::pair<Index, double>> of_frame(size_t t, const Eigen::RowVectorXd& slopes) const {
    std::vector<std::pair<Index, double>> out;
    for (Index k = 0; k < numbers(); ++k) out.emplace_back(at(t) + k, slopes[k]);
    return out;
  }

  void add_sunken_toes(size_t t, NormalEquations& sum) const {
    const FeetPoints points = feet_points(body_, poses_[t]);
    MatrixXd slopes;
    for (const Side side : {Side::kLeft, Side::kRight}) {
      const Index height = first_row(side) + kPointSize + 2;
      if (points[height] >= 0) continue;
      if (slopes.size() == 0) slopes = feet_slopes(t);
      sum.add(SquareTerm{points[height], 1 / (kSlide * kSlide), of_frame(t, slopes.row(height))});
    }
  }

  void add_legs_aside(size_t t, NormalEquations& sum) const {
    const WalkingDirection way = this->way(t);
    if (!way) return;
    const auto aside = [&](const Pose& pose) {
      return legs_aside(forward_kinematics(body_, pose).joints, body_.subject.height, *way);
    };
    const LegsAside off = aside(poses_[t]);
    const MatrixXd slopes = this->slopes(t, aside);
    for (Index i = 0; i < off.size(); ++i)
      sum.add(SquareTerm{off[i], dt_ / kLegsAsideTime, of_frame(t, slopes.row(i))});
  }

  void add_flat(size_t stretch, NormalEquations& sum) const {
    const Index row = first_row(flat_[stretch].side);
    const double height_weight = dt_ / kSoleTime / (kSole * kSole);
    for (size_t t = flat_[stretch].first; t <= flat_[stretch].last; ++t) {
      const FeetPoints points = feet_points(body_, poses_[t]);
      const MatrixXd slopes = feet_slopes(t);
      for (Index axis = 0; axis < 2; ++axis) {
        const Index ankle = row + axis, toe = ankle + kPointSize;
        SquareTerm stays{0.5 * (points[ankle] + points[toe]) - places_[stretch][axis],
                         1 / (kSlide * kSlide),
                         of_frame(t, 0.5 * (slopes.row(ankle) + slopes.row(toe)))};
        stays.slope.emplace_back(place_of(stretch) + axis, -1.0);
        sum.add(stays);
      }
      const std::array heights{body_.lengths.ankle_height, body_.lengths.ball_height};
      for (Index point = 0; point < 2; ++point) {
        const Index height = row + point * kPointSize + 2;
        sum.add(SquareTerm{points[height] - heights[static_cast<size_t>(point)], height_weight,
                           of_frame(t, slopes.row(height))});
      }
    }
  }

  const Body& body_;
  FreeNumbers free_;
  double dt_;
  std::span<const FrameRecord> records_;
  std::span<const FlatFoot> flat_;
  size_t settled_;
  std::span<const WalkingDirection> ways_;
  VectorXd spreads_;
  Poses poses_;
  std::vector<Vector2d> places_;
};

// What is left of a toe in the ground, a few millimetres, the ankle takes.
Pose with_lifted_toes(const Body& body, Pose pose) {
  constexpr int kSteps = 4;
  for (const Side side : {Side::kLeft, Side::kRight}) {
    double& ankle = pose.legs[static_cast<size_t>(side)].ankle_dorsiflexion;
    const auto height = [&] { return forward_kinematics(body, pose).joints[toe(side)].z(); };
    for (int i = 0; i < kSteps; ++i) {
      const double sunk = height();
      if (sunk >= 0) break;
      ankle += kDifference;
      const double slope = (height() - sunk) / kDifference;
      ankle -= kDifference;
      if (std::abs(slope) < 0.1 * body.lengths.ball_forward) break;  // the foot points down
      ankle -= (sunk - 1e-9) / slope;
    }
  }
  return pose;
}

}  // namespace

TrajectoryEstimate most_probable_trajectory(const BodyModel& model, const TrajectoryFrames& frames,
                                            const WantedDraws& wanted) {
  Trajectory trajectory(model, frames);
  for (int round = 0; round < kNewtonSteps; ++round) trajectory.improve();
  TrajectoryEstimate out{trajectory.poses(), {}};
  if (!wanted.settled.empty()) out.draws = trajectory.draws(wanted);
  for (Pose& pose : out.poses) pose = with_lifted_toes(model.body, pose);
  return out;
}

}  // namespace tracker
}  // namespace walktrack
