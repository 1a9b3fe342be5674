#include "jobs/optimise/given_track.h"

#include <algorithm>
#include <optional>
#include <vector>

#include "body/kinematics.h"
#include "core/median.h"
#include "core/parallel_for.h"
#include "jobs/track/input/next_frame.h"
#include "jobs/track/track_run.h"
#include "jobs/track/track_setup.h"
#include "metrics/steps/flat_feet.h"
#include "observation/image_threads.h"
#include "tracker/smooth/joint_fit.h"
#include "tracker/smooth/refinement.h"

namespace walktrack {
inline namespace jobs {

namespace {

constexpr double kReach = 0.5;  // m around the given pose, for the limbs and for its error

std::vector<std::optional<JointFit>> fits_of(const Motion& motion, const BodyModel& model,
                                             double joint_sd, int threads) {
  std::vector<std::optional<JointFit>> out(motion.time.size());
  parallel_for(out.size(), threads,
               [&](size_t i) { out[i] = fit_joints(model, motion.joints[i], joint_sd); });
  return out;
}

// Whether both feet stay where they are for half a second around a row: somebody stands. By hand.
bool stands(const Motion& motion, size_t row) {
  constexpr double kAround = 0.25, kFarthest = 0.04;  // s, m
  for (const Side side : {Side::kLeft, Side::kRight}) {
    const Eigen::Vector3d& here = motion.joints[row][ankle(side)];
    const auto near = [&](size_t i) {
      const Eigen::Vector3d& there = motion.joints[i][ankle(side)];
      return known(there) && (there - here).norm() <= kFarthest;
    };
    for (size_t i = row; i-- > 0 && motion.time[row] - motion.time[i] <= kAround;)
      if (!near(i)) return false;
    for (size_t i = row; i < motion.time.size() && motion.time[i] - motion.time[row] <= kAround;
         ++i)
      if (!near(i)) return false;
  }
  return true;
}

FrameRecord record_of(const BodyModel& model, const JointFit& fit, bool stands, int samples) {
  FrameRecord out;
  out.tracked = true;
  out.modes.standing = stands ? 1 : 0;
  out.estimate.joint_count = model.body.groups.arms ? kJointCount : size_t{kJointCountWithoutArms};
  out.estimate.pose = fit.pose;
  out.estimate.joints = forward_kinematics(model.body, fit.pose).joints;
  out.samples.resize(static_cast<size_t>(samples));
  out.images = {fit.pose, fit.pose, packed(free_numbers(model), fit.information)};
  return out;
}

// Follows the given poses through the videos.
class Follower {
 public:
  Follower(const TrackJob& job, SceneVideo& video, const JobControl& control)
      : job_(job),
        threads_(thread_count(job.config.values.threads)),
        setup_(set_up(job.scene, job.config.values, video.frame_rate(), {}, control)),
        next_(job.scene, video, setup_.observers, setup_.detections),
        evidence_(setup_.observers.size()) {
    set_image_threads(setup_.detections.uses_network() ? 1
                                                       : std::min(threads_, hardware_threads()));
  }

  const BodyModel& model() const { return setup_.scene.model; }
  int threads() const { return threads_; }

  // Reads the next frame. Returns false if there is none.
  bool read(const std::optional<JointFit>& fit, double time) {
    std::vector<Region> regions;
    for (const Camera& camera : setup_.scene.cameras) regions.push_back(region(camera, fit));
    next_.fetch(regions, fit.has_value(), threads_, setup_.observers.size() == 1 ? threads_ : 1);
    if (!next_.there()) return false;
    next_.complete(time, threads_, evidence_);
    return true;
  }

  // The record of the frame that was read.
  FrameRecord record(const JointFit& fit, bool stands) {
    FrameRecord out = record_of(model(), fit, stands, job_.config.values.tracker.samples);
    refine(setup_.scene, evidence_, threads_, out);
    add_information(free_numbers(model()), fit.pose, fit.information, out.images);
    if (setup_.observers.front().learns())
      learn_appearance(model().body, fit.pose, evidence_, threads_, setup_);
    return out;
  }

 private:
  Region region(const Camera& camera, const std::optional<JointFit>& fit) const {
    const double height = model().body.subject.height;
    if (!fit) return search_region(camera, height);
    return person_region(camera, fit->pose.root.head<2>(), height, kReach);
  }

  const TrackJob& job_;
  int threads_;
  TrackSetup setup_;
  NextFrame next_;
  SceneEvidence evidence_;
};

}  // namespace

double floor_height(const Motion& motion, const Subject& subject) {
  std::vector<double> heights;
  for (const FlatFoot& flat : flat_feet(motion, gait_from_motion(motion)))
    for (size_t i = flat.first; i <= flat.last; ++i)
      if (const Eigen::Vector3d& at = motion.joints[i][ankle(flat.side)]; known(at))
        heights.push_back(at.z());
  return heights.empty() ? 0 : median_of(std::move(heights)) - body_lengths(subject).ankle_height;
}

GivenTrack given_track(const Motion& motion, const Subject& subject, double rate, double joint_sd,
                       const Config& config, const ResultFolder& folder) {
  GivenTrack out{{make_body(subject, config.body), {}, Eigen::Vector2d::Zero()},
                 {rate, FrameFile(folder.file(std::string(kFramesFile)))}};
  const auto fits = fits_of(motion, out.model, joint_sd, thread_count(config.threads));
  for (size_t i = 0; i < fits.size(); ++i)
    out.frames.records.append(
        fits[i] ? record_of(out.model, *fits[i], stands(motion, i), config.tracker.samples)
                : FrameRecord{});
  return out;
}

GivenTrack given_track(const Motion& motion, const TrackJob& job, SceneVideo& video,
                       double joint_sd, const ResultFolder& folder, const JobControl& control) {
  Follower follower(job, video, control);
  GivenTrack out{follower.model(),
                 {video.frame_rate(), FrameFile(folder.file(std::string(kFramesFile)))}};
  const auto fits = fits_of(motion, out.model, joint_sd, follower.threads());
  for (size_t i = 0; !control.stopping(); ++i) {
    const std::optional<JointFit>& fit = i < fits.size() ? fits[i] : std::nullopt;
    if (!follower.read(fit, static_cast<double>(i) / video.frame_rate())) break;
    out.frames.records.append(fit ? follower.record(*fit, stands(motion, i)) : FrameRecord{});
    control.progress("comparing with the images", i + 1, fits.size());
  }
  return out;
}

}  // namespace jobs
}  // namespace walktrack
