#include "jobs/plan/cost_model.h"

#include <algorithm>
#include <array>

namespace walktrack {

namespace {

// Nanoseconds, as scripts/measure_costs.py prints them.
constexpr double kDecoding = 2.22;
constexpr double kBackground = 22.2;
constexpr double kAppearance = 2.0e5;
constexpr double kFlowMeasured = 31;
constexpr double kFlowWeighed = 602;
constexpr double kPartProjected = 121;
constexpr double kRowSummed = 8.71;
constexpr double kWalker = 7.54e3;
constexpr double kPartPosed = 60;
constexpr double kFrame = 1.23e5;

// Share of the moves that the first camera lets through (filter/particle_filter.h).
constexpr double kPassed = 0.57;

// Mean layers of a frame with one, two, three cameras.
constexpr std::array<double, 3> kLayers{3.9, 4.7, 4.9};

constexpr double kMsPerNs = 1e-6;

FrameCost::OfCamera camera_cost(const FrameWork& work, const CameraWork& camera, double poses) {
  const double parts = poses * work.parts;
  FrameCost::OfCamera out;
  out.decoding = kMsPerNs * kDecoding * camera.filmed_px;
  if (work.background) out.background = kMsPerNs * kBackground * camera.region_px;
  out.appearance = kMsPerNs * kAppearance * work.classes;
  if (work.flow) out.flow = kMsPerNs * (kFlowMeasured * camera.region_px + kFlowWeighed * parts);
  const bool silhouettes = work.background || work.classes > 0;
  if (silhouettes || work.flow) out.projection = kMsPerNs * kPartProjected * parts;
  if (silhouettes) out.silhouettes = kMsPerNs * kRowSummed * poses * camera.rows;
  return out;
}

}  // namespace

FrameCost frame_cost(const FrameWork& work) {
  FrameCost out;
  const double others = work.particles + kPassed * (work.poses - work.particles);
  for (const CameraWork& camera : work.cameras)
    out.cameras.push_back(camera_cost(work, camera, out.cameras.empty() ? work.poses : others));
  out.walker = kMsPerNs * kWalker * work.particles;
  out.poses = kMsPerNs * (kPartPosed * work.poses * work.parts + kFrame);
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
