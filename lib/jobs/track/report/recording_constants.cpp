#include "jobs/track/report/recording_constants.h"

#include <array>
#include <cmath>
#include <string>

#include <fmt/format.h>

#include "observation/keypoints/keypoint_errors.h"
#include "tracker/figure/girth.h"
#include "tracker/figure/trunk_length.h"

namespace walktrack {
inline namespace jobs {

namespace {

constexpr double kMmPerM = 1000;
// Of the height of the hip centres (Winter 2009, figure 4.1).
constexpr double kHipShare = 0.53;

RecordingConstant height_constant(const ConstantSources& sources) {
  const Stature& stature = *sources.subject.stature;
  const double percent = 100 * stature.sd / stature.height;
  const std::string effect =
      sources.scene.cameras.size() == 1
          ? fmt::format(
                "One camera sees distances, steps and speed in proportion to it: {:.1f} % of "
                "them, {:.2f} m/s of the speed, are as uncertain as it is.",
                percent, percent / 100 * sources.speed)
          : fmt::format(
                "The cameras determine where the subject is; the hips' height, thighs and "
                "shanks are in proportion to it: {:.0f} mm at the hips.",
                kMmPerM * kHipShare * stature.sd);
  return {"height_m", "Height of the subject", stature.height, stature.sd, "m", 2, effect};
}

RecordingConstant girth_constant(double girth) {
  constexpr double kPercent = 100;
  return {"girth_percent",
          "Girth of the subject, of a usual one",
          kPercent * girth,
          kPercent * kGirthSd,
          "%",
          0,
          "Trunk and limbs are so wide. One camera would see a figure that is too thin nearer than "
          "the subject, or crouching."};
}

RecordingConstant trunk_constant(double length) {
  return {"trunk_m",
          "Trunk of the subject, from the hips to the shoulders",
          length,
          kTrunkSd,
          "m",
          3,
          "Shoulders and head are so high above the hips. One camera would see a figure with the "
          "usual trunk of the height farther away than the subject, or nearer."};
}

RecordingConstant lag_constant(const ConstantSources& sources) {
  const FoundLag& lag = *sources.lag;
  const double seconds = lag.frames / sources.frame_rate, sd = lag.sd_frames / sources.frame_rate;
  const std::string& camera = sources.scene.cameras[lag.camera].name;
  return {"lag_s_" + camera,
          fmt::format("Camera {} shows the same moment later, by", camera),
          seconds,
          sd,
          "s",
          3,
          fmt::format("The frames were paired accordingly. Otherwise the cameras would see the "
                      "subject {:.0f} mm apart; {:.0f} mm of this are uncertain.",
                      kMmPerM * seconds * sources.speed, kMmPerM * sd * sources.speed)};
}

struct NamedKind {
  PointKind kind;
  const char* name;
  const char* what;
};

// Offsets of one kind of point, forward and up, from the cameras' together: means weighted by their
// information.
void add_offsets(const ConstantSources& sources, const NamedKind& kind,
                 std::vector<RecordingConstant>& out) {
  const auto& stature = sources.subject.stature;
  const double height = stature ? stature->height : sources.scene.subject.height;
  for (Eigen::Index axis = 0; axis < 2; ++axis) {
    double sum = 0, weights = 0;
    for (const KeypointTerm::State& camera : sources.keypoints) {
      if (camera.use.matched == 0) continue;
      const PointOffset offset = offset_of(camera.errors, kind.kind);
      const double weight = 1 / (offset.sd[axis] * offset.sd[axis]);
      sum += weight * offset.mean[axis];
      weights += weight;
    }
    if (weights == 0) return;
    const double mean = height * sum / weights;
    out.push_back({fmt::format("{}_offset_{}_m", kind.name, axis == 0 ? "forward" : "up"),
                   fmt::format("Detected {} lie {} the joint by", kind.what,
                               axis == 0 ? "in front of" : "above"),
                   mean, height / std::sqrt(weights), "m", 3,
                   fmt::format("Detected points are compared with that place: otherwise they would "
                               "pull the joint {:.0f} mm {}.",
                               kMmPerM * std::abs(mean),
                               axis == 0 ? (mean > 0 ? "forwards" : "backwards")
                                         : (mean > 0 ? "up" : "down"))});
  }
}

}  // namespace

std::vector<RecordingConstant> recording_constants(const ConstantSources& sources) {
  static constexpr std::array kKinds{NamedKind{PointKind::kHip, "hip", "hips"},
                                     NamedKind{PointKind::kKnee, "knee", "knees"},
                                     NamedKind{PointKind::kAnkle, "ankle", "ankles"}};
  std::vector<RecordingConstant> out;
  const SubjectEstimates& subject = sources.subject;
  if (subject.stature) out.push_back(height_constant(sources));
  if (subject.girth) out.push_back(girth_constant(*subject.girth));
  if (subject.trunk) out.push_back(trunk_constant(*subject.trunk));
  if (sources.lag) out.push_back(lag_constant(sources));
  for (const NamedKind& kind : kKinds) add_offsets(sources, kind, out);
  return out;
}

}  // namespace jobs
}  // namespace walktrack
