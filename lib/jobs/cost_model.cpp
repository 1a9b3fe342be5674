#include "jobs/cost_model.h"

#include <algorithm>
#include <array>

namespace walktrack {

namespace {

// Nanoseconds, as scripts/measure_costs.py prints them.
constexpr double kDecoding = 5.94;
constexpr double kBackground = 96.5;
constexpr double kAppearance = 0.593;
constexpr double kFlowMeasured = 55.7;
constexpr double kFlowWeighed = 1040;
constexpr double kPartProjected = 190;
constexpr double kRowSummed = 5.5;
constexpr double kWalker = 1.9e4;
constexpr double kPartPosed = 851;

// Mean layers of a frame with one, two, three cameras.
constexpr std::array<double, 3> kLayers{4.0, 4.3, 5.0};

constexpr double kMsPerNs = 1e-6;

FrameCost::OfCamera camera_cost(const FrameWork& work, const CameraWork& camera) {
  const double parts = work.poses * work.parts;
  FrameCost::OfCamera out;
  out.decoding = kMsPerNs * kDecoding * camera.filmed_px;
  if (work.background) out.background = kMsPerNs * kBackground * camera.region_px;
  out.appearance = kMsPerNs * kAppearance * camera.region_px * work.classes;
  if (work.flow) out.flow = kMsPerNs * (kFlowMeasured * camera.region_px + kFlowWeighed * parts);
  const bool silhouettes = work.background || work.classes > 0;
  if (silhouettes || work.flow) out.projection = kMsPerNs * kPartProjected * parts;
  if (silhouettes) out.silhouettes = kMsPerNs * kRowSummed * work.poses * camera.rows;
  return out;
}

}  // namespace

FrameCost frame_cost(const FrameWork& work) {
  FrameCost out;
  for (const CameraWork& camera : work.cameras) out.cameras.push_back(camera_cost(work, camera));
  out.walker = kMsPerNs * kWalker * work.particles;
  out.poses = kMsPerNs * kPartPosed * work.poses * work.parts;
  return out;
}

double FrameCost::sum() const {
  double total = walker + poses;
  for (const OfCamera& camera : cameras) total += camera.sum();
  return total;
}

double usual_layers(int cameras, int max_layers) {
  const size_t many = std::min(static_cast<size_t>(std::max(cameras, 1)), kLayers.size());
  return std::min(kLayers[many - 1], static_cast<double>(max_layers));
}

}  // namespace walktrack
