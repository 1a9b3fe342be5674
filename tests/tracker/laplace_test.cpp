// The bands of a track are those of a normal distribution at its most probable trajectory
// (tracker/smooth/trajectory.h). Here a long Markov chain explores the distribution itself: the
// silhouettes of every frame in place of their quadratic approximation, the walker, and people's
// accelerations. It changes the pose of one frame at a time and accepts by Metropolis's rule, so
// that it shares with the trajectory neither Newton's steps nor sigma points nor the sparse factor.
#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "core/rng.h"
#include "fixture.h"
#include "made_evidence.h"
#include "tests/observation/scenes.h"
#include "tests/sanitized.h"
#include "tests/tracker/frame_time.h"
#include "tracker/frame_likelihood.h"
#include "tracker/smooth/refinement.h"
#include "tracker/smooth/trajectory.h"

namespace walktrack {
namespace {

using Eigen::Index;
using Eigen::MatrixXd;
using Eigen::VectorXd;

constexpr size_t kSeenFrames = 8;

// Errors of single pixels that are as large as what the pixels say.
CameraEvidence with_errors(CameraEvidence seen, Rng& rng) {
  std::vector<float> row(kEvidenceWidth);
  for (int y = 0; y < kEvidenceHeight; ++y) {
    for (int x = 0; x < kEvidenceWidth; ++x)
      row[static_cast<size_t>(x)] =
          static_cast<float>(log_ratio_at(seen.planes, Appearance{}, x, y) + rng.normal());
    set_row(seen.planes, 0, y, row, 4);
  }
  return seen;
}

// Two cameras see somebody who is 2 cm taller than the model walk above the ground.
struct SeenWalk {
  TrackerScene scene = unseen(test_model(), kDt);
  FreeNumbers free = free_numbers(scene.model);
  VectorXd spreads = spreads_of(free);
  std::vector<SceneEvidence> evidence;
  std::vector<FrameRecord> records;

  SeenWalk() {
    for (const Eigen::Vector3d& from : {Eigen::Vector3d(0.2, -4, 1), Eigen::Vector3d(3.2, -3, 1.5)})
      scene.cameras.push_back(camera_at(from, {0.2, 0, 1.2}, 250, kEvidenceWidth, kEvidenceHeight));
    Subject subject;
    subject.height += 0.02;
    const Body person = make_body(subject, {.head = true, .arms = false});
    Rng rng(3, Purpose::kTest);
    Pose truth = striding();
    truth.root.z() += 0.3;
    for (size_t t = 0; t < kSeenFrames; ++t) {
      SceneEvidence& seen = evidence.emplace_back();
      for (const Camera& camera : scene.cameras)
        seen.push_back(with_errors(evidence_of(camera, person, truth), rng));
      VectorXd off(spreads.size());
      for (double& each : off) each = 0.3 * rng.normal();
      const VectorXd walker = values_of(free, truth) + off.cwiseProduct(spreads);
      records.push_back(record_of(scene.model.body, with_values(free, truth, walker)));
      refine(scene, seen, 1, records.back());
      truth.root.x() += 1.2 * kDt;
      truth.legs[0].hip_flexion -= 1.5 * kDt;
      truth.legs[1].hip_flexion += 2.0 * kDt;
    }
  }
};

// A Markov chain over trajectories whose log-density is that of the header's sum with the images'
// own log-likelihood.
class Chain {
 public:
  Chain(const SeenWalk& walk, Poses start, uint64_t seed)
      : walk_(walk), rng_(seed, Purpose::kTest), poses_(std::move(start)) {
    for (const size_t number : walk_.free) {
      const double a = kPoseNumbers[number].acceleration;
      second_precision_.push_back(1 / (4. / 3 * a * a * 0.025 * std::pow(kDt, 3)));
    }
    for (size_t t = 0; t < kSeenFrames; ++t) {
      MatrixXd precision = unpacked(walk_.free, walk_.records[t].images);
      precision.diagonal() +=
          walk_.spreads.cwiseAbs2().cwiseInverse() +
          6 * Eigen::Map<const VectorXd>(second_precision_.data(), std::ssize(second_precision_));
      steps_.push_back(
          precision.llt().matrixU().solve(MatrixXd::Identity(precision.rows(), precision.cols())));
      own_.push_back(own(t, poses_[t]));
    }
  }

  // Proposes steps of three lengths for every frame.
  void sweep() {
    for (size_t t = 0; t < kSeenFrames; ++t)
      for (const double length : {0.05, 0.15, 0.4}) step(t, length);
  }
  const Poses& poses() const { return poses_; }

 private:
  void step(size_t t, double length) {
    VectorXd z(walk_.spreads.size());
    for (double& each : z) each = rng_.normal();
    const double before = own_[t] + evenness(t);
    const Pose here = poses_[t];
    poses_[t] = with_values(walk_.free, here, values_of(walk_.free, here) + length * steps_[t] * z);
    const double there = own(t, poses_[t]);
    if (std::log(rng_.uniform()) < there + evenness(t) - before) {
      own_[t] = there;
    } else {
      poses_[t] = here;
    }
  }

  // Of the frame's images and its walker.
  double own(size_t t, const Pose& pose) const {
    WalkerParticle particle;
    particle.pose = particle.pose_before = pose;
    const FrameLikelihood likelihood(walk_.scene, walk_.evidence[t], false);
    const FrameLikelihood::Account account = likelihood(particle);
    double sum = 0;
    for (int stage = 0; stage < likelihood.stages(); ++stage) sum += account(stage);
    const VectorXd off = difference(walk_.free, walk_.records[t].images.walker, pose);
    return std::min(1.0, 30 * kDt) * sum -
           0.75 * kDt * off.cwiseQuotient(walk_.spreads).squaredNorm();
  }

  // Of the accelerations in which frame t has a part.
  double evenness(size_t t) const {
    double sum = 0;
    for (size_t i = std::max<size_t>(t, 2) - 1; i <= t + 1 && i + 1 < kSeenFrames; ++i) {
      const VectorXd second = difference(walk_.free, poses_[i], poses_[i + 1]) -
                              difference(walk_.free, poses_[i - 1], poses_[i]);
      for (Index k = 0; k < second.size(); ++k)
        sum -= 0.5 * second_precision_[static_cast<size_t>(k)] * second[k] * second[k];
    }
    return sum;
  }

  const SeenWalk& walk_;
  Rng rng_;
  Poses poses_;
  std::vector<double> second_precision_;  // by free number
  std::vector<MatrixXd> steps_;           // by frame: a root of about the covariance of its pose
  std::vector<double> own_;               // by frame
};

// Means and standard deviations of a middle frame's joint coordinates and knees.
class Moments {
 public:
  Moments(const Body& body) : body_(body) {}
  void add(const Poses& poses) {
    const Pose& pose = poses[kSeenFrames / 2];
    const JointPositions joints = forward_kinematics(body_, pose).joints;
    VectorXd now(3 * kScored.size() + 2);
    for (size_t j = 0; j < kScored.size(); ++j)
      now.segment<3>(3 * static_cast<Index>(j)) = joints[kScored[j]];
    now.tail<2>() << pose.legs[0].knee_flexion, pose.legs[1].knee_flexion;
    values_.push_back(now);
  }
  VectorXd mean() const {
    VectorXd sum = VectorXd::Zero(values_.front().size());
    for (const VectorXd& each : values_) sum += each;
    return sum / double(values_.size());
  }
  VectorXd sd() const {
    const VectorXd middle = mean();
    VectorXd sum = VectorXd::Zero(middle.size());
    for (const VectorXd& each : values_) sum += (each - middle).cwiseAbs2();
    return (sum / double(values_.size())).cwiseSqrt();
  }

 private:
  static constexpr std::array kScored{Joint::kPelvis,    Joint::kLeftHip,  Joint::kLeftKnee,
                                      Joint::kLeftAnkle, Joint::kRightHip, Joint::kRightKnee,
                                      Joint::kRightAnkle};
  const Body& body_;
  std::vector<VectorXd> values_;
};

TEST(Laplace, BandsAreThoseOfALongMarkovChain) {
  if (kSanitized) GTEST_SKIP() << "half a million silhouettes take minutes with a sanitizer";
  constexpr size_t kSweeps = 10000, kDraws = 1000;
  const SeenWalk walk;
  const std::vector<Poses> none(kDraws);
  const TrajectoryEstimate normal =
      most_probable_trajectory(walk.scene.model, {kDt, walk.records}, {none, 5, 0});
  Moments by_laplace(walk.scene.model.body), by_chains(walk.scene.model.body);
  for (const Poses& draw : normal.draws) by_laplace.add(draw);
  for (const uint64_t seed : {1, 2, 3}) {
    Chain chain(walk, normal.draws[seed], seed);
    for (size_t i = 0; i < kSweeps; ++i) {
      chain.sweep();
      if (i >= kSweeps / 5) by_chains.add(chain.poses());
    }
  }
  const VectorXd ratio = by_chains.sd().cwiseQuotient(by_laplace.sd());
  const VectorXd shift = (by_chains.mean() - by_laplace.mean()).cwiseQuotient(by_laplace.sd());
  EXPECT_LT(std::sqrt(shift.squaredNorm() / double(shift.size())), 0.9) << shift.transpose();
  double mean = 0, count = 0;
  for (Index k = 0; k < ratio.size(); ++k) {
    // Heights are known to 1.5 mm; there the distribution is wider than its curvature says.
    const bool upwards = k < ratio.size() - 2 && k % 3 == 2;
    EXPECT_GT(ratio[k], 0.65) << k;
    EXPECT_LT(ratio[k], upwards ? 2 : 1.4) << k;
    if (!upwards) mean += ratio[k], ++count;
  }
  EXPECT_NEAR(mean / count, 1, 0.2) << ratio.transpose();
}

}  // namespace
}  // namespace walktrack
