// How images become likelihoods. The defaults are the only defaults; the YAML mirrors them.
#pragma once

#include <array>
#include <string>

#include "body/body.h"

namespace walktrack {
inline namespace observation {

// Whether a term is on; auto is decided before anything is tracked.
enum class TermSetting { kAuto, kOn, kOff };

struct BackgroundConfig {
  bool enabled = true;
  int samples = 32;  // frames that the model is made of, spread over what it is given
  // Whether people, whom the pose network finds, are left out of a model that is made of the video.
  TermSetting without_people = TermSetting::kAuto;
  double noise = 3;         // smallest standard deviation of a channel, grey levels of 256
  double jitter_px = 0.35;  // edges move about so much (compression, wind), px of the shrunk image
  double shadow_darkest = .45;  // a cast shadow keeps at least this share of a pixel's value
  double shadow_share = .15;    // prior probability that a background pixel lies in a shadow
  double shadow_tint = 5;       // standard deviation of a shadow's chroma, grey levels
  double shadow_sky = .2;       // and per grey level that the shadow takes: skylight is blue
  double gradient_weight =
      .5;                      // of the gradient's log-density: it is not independent of the colour
  double unknown_share = .02;  // of a background pixel looking like nothing learned
  double drift_rate = .02;     // share of a frame that an explained pixel takes on; 0 = frozen
};

struct ForegroundConfig {
  bool enabled = true;
  // Which appearances share a model, by Appearance {trunk, legs, feet, head, arms}: equal numbers
  // share one. Left and right always do.
  std::array<int, kAppearanceCount> classes{0, 1, 2, 3, 4};
  double broad_share = .1;     // of a class's model that expects any colour
  double prior_pixels = 60;    // weight of "any colour" against the pixels learned from
  double learning_rate = .05;  // share of a new frame in the recent half of a model
  double anchor_share = .5;    // share of the first frames learned that is never forgotten
};

struct FlowConfig {
  TermSetting enabled = TermSetting::kAuto;
  // Of the Student-t, fitted to a real video (reports/flow.md).
  double noise = 1.2;        // of a difference without texture, grey levels of 256
  double error_px = .35;     // of what rests, px: pictures tremble, edges are compressed
  double error_share = .05;  // and more of what moves, as a share of its motion
  double dof = 1.7;          // the smaller, the more outliers are expected
  double weight = .5;        // against the silhouettes, both per independent area
};

// Points of a pose detector: from the scene's files, or from the built-in network where a camera
// has none.
struct KeypointConfig {
  TermSetting enabled = TermSetting::kAuto;  // decided before anything is tracked
  int every = 3;                             // frames, of which the network looks at one
  // Whether it looks at a tracked subject only while left and right are in doubt
  // (tracker/smooth/leg_labels.h).
  bool in_doubt_only = false;
  std::string model = "movenet_lightning";  // the shipped network, or a file of the same family
  // Of one point: a network's points err together from joint to joint and for several frames.
  double weight = .2;
  // Probability that the names of a frame's left and right are swapped. Of clear views it is below
  // one in a hundred, but those that there are come in runs of several frames, each of which would
  // be counted.
  double flip = .1;
  // Whether they count for more than outlines (tracker/start/keypoint_lead.h); auto: where outlines
  // do not fit. Off: never.
  TermSetting lead = TermSetting::kAuto;
  double dof = 3;        // of the Student-t: the smaller, the more outliers are expected
  double outlier = .25;  // radius in which stray points lie, share of the person's height
};

struct ObservationConfig {
  BackgroundConfig background;
  ForegroundConfig foreground;
  FlowConfig flow;
  KeypointConfig keypoints;
  // Images are shrunk by a whole factor while a standing subject stays at least this high.
  double person_px = 120;
  double clip = 4;  // of a pixel's log-ratio, nats, both ways: what one pixel may say at most
  // Neighbouring pixels err together (a body is not quite our body's shape, clothes fold), so a
  // patch of this side counts as one independent pixel. On the body, hence in metres: a figure
  // twice as large in the image has not four times the evidence.
  double independent_m = .1;
  // Of the outlines' evidence that counts: less where keypoints lead (KeypointConfig::lead).
  double outline_share = 1;
};

}  // namespace observation
}  // namespace walktrack
