#include "jobs/render/render_keypoints.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "core/rng.h"

namespace walktrack {
inline namespace jobs {

namespace {

using enum KeypointName;

constexpr std::array kPoints{std::pair{kNose, Joint::kHead},
                             std::pair{kNeck, Joint::kNeck},
                             std::pair{kMidHip, Joint::kPelvis},
                             std::pair{kLeftShoulder, Joint::kLeftShoulder},
                             std::pair{kRightShoulder, Joint::kRightShoulder},
                             std::pair{kLeftElbow, Joint::kLeftElbow},
                             std::pair{kRightElbow, Joint::kRightElbow},
                             std::pair{kLeftWrist, Joint::kLeftWrist},
                             std::pair{kRightWrist, Joint::kRightWrist},
                             std::pair{kLeftHip, Joint::kLeftHip},
                             std::pair{kRightHip, Joint::kRightHip},
                             std::pair{kLeftKnee, Joint::kLeftKnee},
                             std::pair{kRightKnee, Joint::kRightKnee},
                             std::pair{kLeftAnkle, Joint::kLeftAnkle},
                             std::pair{kRightAnkle, Joint::kRightAnkle},
                             std::pair{kLeftBigToe, Joint::kLeftToe},
                             std::pair{kRightBigToe, Joint::kRightToe}};
constexpr std::array kLegPairs{std::pair{kLeftHip, kRightHip}, std::pair{kLeftKnee, kRightKnee},
                               std::pair{kLeftAnkle, kRightAnkle},
                               std::pair{kLeftBigToe, kRightBigToe}};
constexpr double kLeastConfidence = 0.4;  // of a rendered point; by hand
// Streams of random numbers after those of the cameras' sensors; a camera has several for each
// person.
constexpr uint32_t kStreams = 1u << 30, kStreamsOfCamera = 1u << 10;

bool within(const std::vector<TimeSpan>& spans, double time) {
  return std::any_of(spans.begin(), spans.end(),
                     [&](const TimeSpan& span) { return time >= span.from && time <= span.to; });
}

bool in_picture(const Camera& camera, const Eigen::Vector2d& px) {
  return px.x() >= -0.5 && px.y() >= -0.5 && px.x() < camera.width_px - 0.5 &&
         px.y() < camera.height_px - 0.5;
}

double height_px(const Camera& camera, const JointPositions& joints) {
  const auto head = project(camera, joints[Joint::kHead]);
  const auto foot = project(camera, 0.5 * (joints[Joint::kLeftAnkle] + joints[Joint::kRightAnkle]));
  return head && foot ? (*head - *foot).norm() : 0;
}

struct Draws {
  Rng rng;
  const KeypointFaults& faults;
  double height_px;

  Keypoint point(const Eigen::Vector2d& true_px) {
    // The same number of draws for every point, so that one detection error does not change others.
    const double lost = rng.uniform(), confidence = kLeastConfidence + 0.6 * rng.uniform();
    const double sd = faults.noise * height_px / std::sqrt(confidence);
    const double dx = sd * rng.normal(), dy = sd * rng.normal();
    if (lost < faults.dropout) return {};
    const double up = faults.bias * height_px;
    return {static_cast<float>(true_px.x() + dx), static_cast<float>(true_px.y() + dy - up),
            static_cast<float>(confidence)};
  }
};

void swap_legs(DetectedPerson& person) {
  for (const auto& [left, right] : kLegPairs) std::swap(person[left], person[right]);
}

}  // namespace

DetectedPeople rendered_keypoints(const Stage& stage, const Camera& camera,
                                  const KeypointFaults& faults, uint64_t seed, uint32_t stream,
                                  uint32_t frame, double time) {
  DetectedPeople people;
  Rng rng(seed, Purpose::kRendering, frame, kStreams + stream);
  for (size_t i = 0; i < stage.actors.size(); ++i) {
    const JointPositions joints = joints_at(stage.actors[i], time);
    const bool swapped = rng.uniform() < faults.flips || within(faults.flipped, time);
    if (i == 0 && within(faults.missing, time)) continue;
    const auto person_stream =
        kStreams + kStreamsOfCamera * (stream + 1) + static_cast<uint32_t>(i);
    Draws draws{Rng(seed, Purpose::kRendering, frame, person_stream), faults,
                height_px(camera, joints)};
    DetectedPerson person;
    for (const auto& [name, joint] : kPoints) {
      if (!known(joints[joint]) || joints[joint].isZero()) continue;
      const auto px = project(camera, joints[joint]);
      if (px && in_picture(camera, *px)) person[name] = draws.point(*px);
    }
    if (swapped) swap_legs(person);
    const bool there = std::any_of(person.points.begin(), person.points.end(),
                                   [](const Keypoint& point) { return point.confidence > 0; });
    if (there) people.push_back(person);
  }
  if (people.size() > 1 && rng.uniform() < 0.5) std::reverse(people.begin(), people.end());
  return people;
}

std::string openpose_json(const DetectedPeople& people) {
  std::string out = R"({"version": 1.3, "people": [)";
  for (size_t i = 0; i < people.size(); ++i) {
    out += fmt::format(R"({}{{"person_id": [-1], "pose_keypoints_2d": [)", i == 0 ? "" : ", ");
    for (size_t k = 0; k < kKeypointCount; ++k) {
      const Keypoint& point = people[i].points[k];
      out += fmt::format("{}{:.2f}, {:.2f}, {:.3f}", k == 0 ? "" : ", ", point.x_px, point.y_px,
                         point.confidence);
    }
    out += "]}";
  }
  return out + "]}\n";
}

std::string keypoint_folder(const std::string& camera) { return camera + "_keypoints"; }

std::string openpose_file_name(const std::string& camera, size_t frame) {
  return fmt::format("{}_{:012}{}", camera, frame, kOpenPoseEnding);
}

}  // namespace jobs
}  // namespace walktrack
