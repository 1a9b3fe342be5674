// A scene to be filmed: the walkers with their bodies, the cameras in their places, the world about
// them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "body/body.h"
#include "synth/figure.h"
#include "synth/render_options.h"
#include "synth/view.h"

namespace walktrack {
inline namespace synth {

// A walker with what is worn. The first of a stage is the one that the truth is about.
struct Actor {
  Motion motion;  // in the scene's place and time (0 = scene time 0)
  Body body;
  Clothes worn;
};

struct Stage {
  std::vector<Actor> actors;
  std::vector<Camera> cameras;  // as in options.cameras, or the one default
  World world;
  double duration;  // s
};

// As stated, or as the motion has it, to the millimetre.
double height_of(const FilmedWalker& walker);

// Takes cameras with a calibration as `calibrated` gives them (in the order of options.cameras).
// Throws InputError when the motion has no row with both legs between start and end.
Stage make_stage(const FilmedWalker& walker, const RenderOptions& options,
                 const std::vector<std::optional<Camera>>& calibrated);

// An actor's joints at a time, as they are rendered; unknown where they are not there.
JointPositions joints_at(const Actor& actor, double time);

// The parts of all actors that are there at a time, in their order: an actor whose joints are
// unknown is left out of the picture (no solids).
std::vector<DressedParts> actors_at(const Stage& stage, double time);

// The first actor's joints at these times, as they are rendered.
Motion truth_at(const Stage& stage, std::span<const double> times);

// Light that the camera's shutter lets in for the frame at `time`; `frame_rate` is the camera's.
Plane<Colour> exposed(const Stage& stage, const View& view, const Shutter& shutter, double time,
                      double frame_rate);

}  // namespace synth
}  // namespace walktrack
