// What a likelihood term is. CONTRIBUTING.md says how to add one; terms.h holds the list of all of
// them.
//
// A term is a struct that is never made. kName is what results call it, kStage says when particles
// are asked, kAsksBefore whether they need the pose of the frame before as well, kSwitches which
// flags of the configuration turn it on (none: it is always there), describe() their keys.
//
// Evidence is what one frame of one camera holds for it, a base of CameraEvidence; State what it
// remembers from frame to frame, a base of ObserverState. Memory is that with its rules: prepare()
// while particles are still busy with the frame before, complete() when they are done, learn() from
// the pose that was found.
//
// says() tells whether a frame's evidence holds anything, log_likelihood() what it says of a body,
// up to a constant of the frame, in nats, from any number of threads and without allocations,
// cost() the CPU time of a frame.
//
// A term that is off says nothing, prepares nothing and holds no memory.
#pragma once

#include <span>
#include <string_view>
#include <utility>
#include <vector>

#include "body/kinematics.h"
#include "camera/camera.h"
#include "observation/observation_config.h"

namespace walktrack {
inline namespace observation {

class CapsuleList;
struct CameraEvidence;   // terms.h
struct ObserverInput;    // observer.h
struct ObserverSetting;  // observed_frame.h
struct ObservedFrame;    // observed_frame.h

// Delayed acceptance (filter/particle_filter.h): a move that one stage rejects is not shown to the
// next. Terms that are quick or strong come first.
enum class TermStage {
  kEarly,   // the first camera's before anything else, those of other cameras with the late terms
  kLate,    // after all early terms of the first camera
  kTracks,  // never of a particle: only of whole tracks
};

// A body and where its parts are. Lives on the stack.
struct PosedBody {
  // `shape` has to outlive this.
  PosedBody(const Body& shape, const Pose& pose)
      : body(&shape),
        skeleton(forward_kinematics(shape, pose)),
        parts(pose_parts(shape, skeleton)) {}

  const Body* body;
  Skeleton skeleton;
  PosedParts parts;
};

// A flag of the configuration, observation.<key>.enabled.
struct TermSwitch {
  std::string_view key;
  std::string_view plan_name;  // what `walktrack plan` calls it
  std::string_view what;       // and says of it
  bool (*on)(const ObservationConfig&);
};

// What there is to be done in a frame of one camera.
struct TermWork {
  double region_px = 0;  // pixels of the shrunk image around the subject
  double rows = 0;       // that the subject covers there
  double poses = 0;      // asked about, particles and moves together
  int parts = 0;         // of the body
  int classes = 0;       // appearances told apart; 0 = appearance is off
};

struct TermCost {
  std::string_view what;  // it is spent on
  double cpu_ns;
};
// Empty for a term that is off.
using TermCosts = std::vector<TermCost>;

// A pose that was found in the frame observed last.
struct FoundPose {
  const CapsuleList& capsules;
  const PosedBody* body;  // nullptr = not known
};

}  // namespace observation
}  // namespace walktrack
