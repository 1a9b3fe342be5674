// A scene to be rendered: the walkers with their bodies, the posed cameras, and the world around
// them.
#pragma once

#include <optional>
#include <span>
#include <vector>

#include "body/body.h"
#include "synth/recording/render_options.h"
#include "synth/recording/view.h"
#include "synth/world/figure.h"

namespace walktrack {
inline namespace synth {

// A person with their clothes. The first one of a stage is the subject of the truth.
struct Actor {
  Motion motion;  // in the scene's axes and time (0 = scene time 0)
  Body body;
  Clothes worn;
};

struct Stage {
  std::vector<Actor> actors;
  std::vector<Camera> cameras;  // of options.cameras, or the default one
  World world;
  double duration;  // s
};

// The stated height, or that of the motion, to the millimetre.
double height_of(const FilmedWalker& walker);

// Uses `calibrated` for cameras with a calibration (in the order of options.cameras). Throws
// InputError if no row of the motion between start and end has both legs.
Stage make_stage(const FilmedWalker& walker, const RenderOptions& options,
                 const std::vector<std::optional<Camera>>& calibrated);

// An actor's joints at a time, as they are rendered; unknown if the actor is absent.
JointPositions joints_at(const Actor& actor, double time);

// The parts of all actors that are present at a time, in their order; an actor with unknown joints
// has no solids.
std::vector<DressedParts> actors_at(const Stage& stage, double time);

// The first actor's joints at these times, as they are rendered.
Motion truth_at(const Stage& stage, std::span<const double> times);

// The light that the shutter of the camera collects for the frame at `time`; `frame_rate` is the
// camera's.
Plane<Colour> exposed(const Stage& stage, const View& view, const Shutter& shutter, double time,
                      double frame_rate);

}  // namespace synth
}  // namespace walktrack
