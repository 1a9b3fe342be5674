// How images become likelihoods. The defaults are the only defaults; the YAML mirrors them.
#pragma once

#include <array>
#include <string>

#include "body/body.h"

namespace walktrack {
inline namespace observation {

// Whether a term is on; auto is decided before tracking.
enum class TermSetting { kAuto, kOn, kOff };

struct BackgroundConfig {
  bool enabled = true;
  int samples = 32;  // frames for the estimate of the model, evenly spread
  // Whether people that the pose network detects are left out of a model from the video.
  TermSetting without_people = TermSetting::kAuto;
  double noise = 3;             // smallest standard deviation of a channel, grey levels of 256
  double jitter_px = 0.35;      // shaking of edges (compression, wind), px of the shrunk image
  double shadow_darkest = .45;  // smallest ratio of a pixel's value in a cast shadow
  double shadow_share = .15;    // prior probability that a background pixel is in a shadow
  double shadow_tint = 5;       // standard deviation of a shadow's chroma, grey levels
  double shadow_sky = .2;       // and per grey level that the shadow takes: skylight is blue
  double gradient_weight = .5;  // weight of the gradient's log-density, which is not independent of
                                // the colour
  double unknown_share = .02;   // probability that a background pixel has any colour
  double drift_rate = .02;      // learning rate for pixels that the model explains; 0 = constant
};

struct ForegroundConfig {
  bool enabled = true;
  // Which appearances share a model, by Appearance {trunk, legs, feet, head, arms}: equal numbers
  // share one. Left and right always do.
  std::array<int, kAppearanceCount> classes{0, 1, 2, 3, 4};
  double broad_share = .1;     // of a class's model that is uniform over colours
  double prior_pixels = 60;    // weight of the uniform model in pixels
  double learning_rate = .05;  // learning rate of the recent half of a model
  double anchor_share = .5;    // share of the anchor, which is learned from the first frames and
                               // kept
};

struct FlowConfig {
  TermSetting enabled = TermSetting::kAuto;
  // Of the Student-t, fitted to a real video (reports/flow.md).
  double noise = 1.2;        // of a difference without texture, grey levels of 256
  double error_px = .35;     // error of what is at rest, px: images shake, edges are compressed
  double error_share = .05;  // additional error of what moves, as a share of its motion
  double dof = 1.7;          // the smaller, the more outliers are expected
  double weight = .5;        // relative to silhouettes, both for an independent area
};

// Points of a pose detector: from the scene's files, or from the built-in network where a camera
// has none.
struct KeypointConfig {
  TermSetting enabled = TermSetting::kAuto;  // decided before tracking
  // Frames from one use of the network to the next; 0: by the video's frame rate
  // (jobs/track/input/detections.h).
  int every = 0;
  // Whether, while a subject is tracked, it only runs if left and right are uncertain
  // (tracker/smooth/leg_labels.h).
  bool in_doubt_only = false;
  std::string model = "movenet_lightning";  // the shipped network, or a file of the same family
  // Weight of one point; less than 1 if its errors are taken to last for several frames.
  double weight = 1;
  // Probability that left and right are swapped in a frame. For clear views it is below one in a
  // hundred, but swapped frames come in runs, each of which would be counted several times.
  double flip = .1;
  // Whether keypoints count for more than outlines (tracker/start/keypoint_lead.h); auto: if
  // outlines do not fit.
  TermSetting lead = TermSetting::kAuto;
  double dof = 3;        // of the Student-t: the smaller, the more outliers are expected
  double outlier = .25;  // radius of the distribution of outliers, share of the person's height
};

struct ObservationConfig {
  BackgroundConfig background;
  ForegroundConfig foreground;
  FlowConfig flow;
  KeypointConfig keypoints;
  // Images are shrunk by a whole factor while a standing subject stays at least this high.
  double person_px = 120;
  double clip = 4;  // limit of a pixel's log-likelihood ratio, nats
  // Neighbouring pixels have common errors (the subject's shape differs from the model's, clothes
  // fold), so that a patch of this side counts as one independent pixel. It is measured on the
  // body, in metres: a figure twice as large in the image does not have four times the evidence.
  double independent_m = .1;
  // Share of the outlines' evidence that is used: less beside keypoints, and less still if they
  // lead (KeypointConfig::lead).
  double outline_share = 1;
};

// What outlines and keypoints count for together.
struct EvidenceWeights {
  double outline_share, point_weight;  // ObservationConfig::outline_share, KeypointConfig::weight
  double flip;                         // KeypointConfig::flip
};
// Outlines alone take the errors of girth, arms and clothes, which last for strides, for a wrong
// distance or pose. Beside keypoints, whose errors are others, they count for less. The outlines of
// several cameras tell left from right, so that a detector's labels, which are swapped for strides,
// are not needed there (reports/weights.md).
inline constexpr EvidenceWeights weights_for(size_t cameras, bool keypoints) {
  return {keypoints ? 1.0 / 3 : 1, 1, cameras == 1 ? .1 : .5};
}

}  // namespace observation
}  // namespace walktrack
