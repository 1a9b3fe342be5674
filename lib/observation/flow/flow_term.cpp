#include "observation/flow/flow_term.h"

#include <utility>

#include <opencv2/imgproc.hpp>

#include "observation/observed_frame.h"

namespace walktrack {
inline namespace observation {

namespace {

// CPU time for a frame, nanoseconds, as scripts/measure_costs.py prints it.
constexpr double kFlowMeasured = 31;
constexpr double kFlowWeighed = 380;

// Only the legs are used: the upper body moves little relative to them, silhouettes determine it as
// well, and the arms of people pass in front of a body without arms.
CapsuleList project_legs(const Camera& camera, const PosedParts& parts) {
  PosedParts legs;
  for (const PosedPart& part : parts)
    if (part.appearance == Appearance::kLegs || part.appearance == Appearance::kFeet)
      legs.push_back(part);
  return project_parts(camera, legs);
}

}  // namespace

void FlowTerm::Memory::prepare(const ObserverSetting& setting, ObservedFrame& frame, int,
                               Prepared& out) const {
  out.flow.area = {};  // empty, but with its memory, if there is no previous frame
  out.flow.cells.clear();
  if (!is_on(setting.config.flow) || frame.bgr.empty() || state_.grey_before.pixels.empty()) return;
  make_flow_field(setting.config, state_.grey_before, grey_of(frame), frame.background,
                  frame.region.area, frame.region.metres_per_px, out.flow);
}

void FlowTerm::Memory::complete(const ObserverSetting& setting, ObservedFrame& frame,
                                Prepared& prepared, CameraEvidence& out) {
  std::swap(out.flow, prepared.flow);
  if (!is_on(setting.config.flow)) return;
  if (setting.occluded) block(setting.mask, out.flow);
  finish_flow_field(out.flow);
  state_.grey_before = frame.bgr.empty() ? GreyImage{} : grey_of(frame);
}

bool FlowTerm::Memory::fits(const ObserverSetting& setting, const State& state) const {
  const GreyImage& grey = state.grey_before;
  const bool sized =
      grey.width == setting.camera.width_px && grey.height == setting.camera.height_px &&
      grey.pixels.size() == static_cast<size_t>(grey.width) * static_cast<size_t>(grey.height);
  return grey.pixels.empty() || sized;
}

bool FlowTerm::says(const CameraEvidence& evidence) { return !evidence.flow.cells.empty(); }

double FlowTerm::log_likelihood(const ObservationConfig& config, const CameraEvidence& evidence,
                                const Camera& camera, const PosedBody& now,
                                const PosedBody* before) {
  return evidence.pixel_weight * config.flow.weight *
         flow_log_ratio(config.flow, evidence.flow, project_legs(camera, now.parts),
                        project_legs(camera, before->parts));
}

TermCosts FlowTerm::cost(const ObservationConfig& config, const TermWork& work) {
  if (!is_on(config.flow)) return {};
  return {{"flow", kFlowMeasured * work.region_px + kFlowWeighed * work.poses * work.parts}};
}

}  // namespace observation
}  // namespace walktrack
