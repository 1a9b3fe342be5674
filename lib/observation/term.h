// The definition of a likelihood term. CONTRIBUTING.md says how to add one; terms.h has the list of
// all terms.
//
// A term is a struct of which no object is made. kName is its name in results, kStage states when
// it is computed for particles, kAsksBefore whether it also needs the pose in the previous frame,
// kSwitches which flags of the configuration turn it on (none: it is always on), and describe() the
// keys of these flags.
//
// Evidence is the data of one frame of one camera for this term, a base of CameraEvidence; State is
// the data that it keeps from frame to frame, a base of ObserverState. Memory is the state with its
// functions: prepare() while particles are still being weighted with the previous frame, complete()
// afterwards, learn() from the pose that was found.
//
// says() returns whether a frame has any evidence for this term; log_likelihood() returns the
// log-likelihood of a body up to a constant of the frame, in nats, and may be called from any
// number of threads and does not allocate; cost() returns the CPU time of a frame.
//
// A term that is off has no evidence, prepares nothing and uses no memory.
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

// Delayed acceptance (filter/particle_filter.h): a move that one stage rejects is not computed for
// the next one. Terms that are quick or strong come first.
enum class TermStage {
  kEarly,   // the first camera's before anything else, those of other cameras with the late terms
  kLate,    // after all early terms of the first camera
  kTracks,  // never for a particle, only for whole tracks
};

// A body with the positions of its parts. It is stored on the stack.
struct PosedBody {
  // `shape` has to outlive this object.
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
  std::string_view plan_name;  // its name in `walktrack plan`
  std::string_view what;       // and its description there
  bool (*on)(const ObservationConfig&);
};

// The work for a frame of one camera.
struct TermWork {
  double region_px = 0;  // pixels of the shrunk image around the subject
  double rows = 0;       // height of the subject there
  double poses = 0;      // evaluated poses, of particles and moves together
  int parts = 0;         // of the body
  int classes = 0;       // appearance classes; 0 = appearance is off
};

struct TermCost {
  std::string_view what;  // the operation
  double cpu_ns;
};
// Empty for a term that is off.
using TermCosts = std::vector<TermCost>;

// The pose that was found in the last frame.
struct FoundPose {
  const CapsuleList& capsules;
  const PosedBody* body;  // nullptr = unknown
};

}  // namespace observation
}  // namespace walktrack
