// Keypoints: the points of a pose network, from a file or the built-in one, compared with a pose.
//
// With the distance r_j of a detected point j from its projection for the pose (keypoint_points.h),
// a person's points have the log-likelihood ratio, relative to a uniform distribution near the
// person,
//   l_j = log p(r_j) - log u,   p = Student-t of two coordinates of scale s_j,   u = 1 / (pi R^2),
//   s_j = scale of its kind x height of the person in the image / sqrt(confidence),
//   R = outlier x that height.
// A detector may swap the labels left and right of both legs together, or of both arms: for the
// points G of either group, and with m(j) the same point of the other side,
//   l_G = log[ (1 - flip) exp(w sum of l_j) + flip exp(w sum of l_m(j)) ],
// where w tempers points that err together, from joint to joint and from frame to frame. Either one
// of the people in an image is the subject, or none of them:
//   log p = log[ 1 + sum over people of exp(w l_head + l_arms + l_legs) ] + constant,
// so that people far from a pose change nothing. Missing points are no evidence.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <type_traits>
#include <vector>

#include "observation/keypoints/keypoint_errors.h"
#include "observation/term.h"

namespace walktrack {
inline namespace observation {

// The evidence of a frame's keypoints, in pixels of the shrunk image.
struct KeypointEvidence {
  struct Point {
    Eigen::Vector2d px = Eigen::Vector2d::Zero();
    double precision = 0;  // 1 / (dof s^2); 0 = missing
    double at_best = 0;    // l_j for r = 0
  };
  using Person = std::array<Point, kBodyPoints>;

  std::vector<Person> people;
  PointOffsets offsets;
};

// The median distance of a person's points from their projections for a pose, px; NaN if none was
// detected.
double median_distance(const KeypointEvidence::Person& person, const PointPixels& predicted);

// Counts for one camera, for run.json.
struct KeypointUse {
  int64_t frames = 0;        // tracked frames in which people were detected
  int64_t matched = 0;       // those in which one of them is the subject
  int64_t legs_flipped = 0;  // those in which the labels of the legs are swapped
};

inline bool is_on(const KeypointConfig& config) { return config.enabled == TermSetting::kOn; }

struct KeypointTerm {
  static constexpr std::string_view kName = "keypoints";
  static constexpr TermStage kStage = TermStage::kEarly;
  static constexpr bool kAsksBefore = false;
  static constexpr std::array kSwitches{
      TermSwitch{"keypoints", "keypoints", "points of the body that a pose network has found",
                 [](const ObservationConfig& c) { return is_on(c.keypoints); }}};

  struct Evidence {
    KeypointEvidence keypoints;  // empty if the term is off or nobody was detected
  };

  struct State {
    KeypointErrors errors = initial_errors();
    KeypointUse use;
  };

  struct Prepared {
    std::vector<SeenPoints> people;
  };

  class Memory {
   public:
    Memory(const ObserverSetting& setting, ObserverInput& input);
    void prepare(const ObserverSetting& setting, ObservedFrame& frame, int threads,
                 Prepared& out) const;
    void complete(const ObserverSetting& setting, ObservedFrame& frame, Prepared& prepared,
                  CameraEvidence& out);
    void forget() {}
    static bool learns(const ObservationConfig& config) { return is_on(config.keypoints); }
    void learn(const ObserverSetting& setting, const CameraEvidence& evidence,
               const FoundPose& found);
    State state() const { return state_; }
    bool fits(const ObserverSetting&, const State&) const { return true; }
    void resume(const ObserverSetting&, State state) { state_ = state; }

   private:
    bool arms_;
    State state_;
  };

  template <typename Groups>
  static void describe(Groups& groups);

  static bool says(const CameraEvidence& evidence);
  static double log_likelihood(const ObservationConfig& config, const CameraEvidence& evidence,
                               const Camera& camera, const PosedBody& now, const PosedBody* before);
  static TermCosts cost(const ObservationConfig& config, const TermWork& work);

  // Whether a pose agrees with one of the detected people; nullopt if nobody was detected near it:
  // a person further away than half the figure's height is somebody else.
  static std::optional<bool> on_somebody(const ObservationConfig& config,
                                         const CameraEvidence& evidence, const Camera& camera,
                                         const PosedBody& now);

  // Log-odds of the labels of the legs against swapped ones by this frame's points, nats.
  static double names_log_odds(const ObservationConfig& config, const Body& body,
                               const Camera& camera, const CameraEvidence& evidence_before,
                               const CameraEvidence& evidence, const PosedBody& before,
                               const PosedBody& now);
};

template <typename Groups>
void KeypointTerm::describe(Groups& groups) {
  using K = KeypointConfig;
  auto k = groups.group("keypoints", "points of a pose detector", &ObservationConfig::keypoints);
  k.setting(
      "enabled", &K::enabled,
      "on: from the scene's files, from the built-in network where a camera has none; auto: where "
      "every camera has a file, and the network for one camera alone");
  k.integer("every", &K::every, 0, 1000,
            "frames from one use of the network to the next; 0 = 3, and less below 25 Hz, for some "
            "ten uses a second");
  k.flag(
      "in_doubt_only", &K::in_doubt_only,
      "whether the network is used for a tracked subject only while left and right are uncertain");
  k.text("model", &K::model, "the shipped network, or the ONNX file of one of the same family");
  k.number(
      "weight", &K::weight, 0, 10,
      "weight of a point, the less, the more the errors of points and of frames are correlated; "
      "0 = 1");
  k.choice(
      "lead", &K::lead,
      {{"auto", TermSetting::kAuto}, {"on", TermSetting::kOn}, {"off", TermSetting::kOff}},
      "whether keypoints count for more than outlines; auto: with one camera, if the subject is "
      "much wider than the figure");
  k.number("flip", &K::flip, 0, 0.5,
           "probability that a frame's left and right are swapped; 0 = 0.1 with one camera and 0.5 "
           "with more, whose outlines tell the legs apart");
  k.number("dof", &K::dof, 0.5, 1000,
           "degrees of freedom of the Student-t; fewer expect more outliers");
  k.number("outlier", &K::outlier, 0.01, 10,
           "radius in which outliers lie, as a share of the subject's height");
}

template <typename Archive, typename T>
requires std::is_same_v<std::remove_const_t<T>, KeypointTerm::State>
void fields(Archive& archive, T& value) {
  auto& [errors, use] = value;
  auto& [scale, seen, information, pull] = errors;
  auto& [frames, matched, legs_flipped] = use;
  archive(scale, seen, information, pull, frames, matched, legs_flipped);
}

}  // namespace observation
}  // namespace walktrack
