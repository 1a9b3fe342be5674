#include "jobs/plan/cost_model.h"

#include <algorithm>
#include <array>

#include "observation/terms.h"

namespace walktrack {
inline namespace jobs {

namespace {

// Nanoseconds, as scripts/measure_costs.py prints them; the costs of likelihood terms are stated
// with the terms.
constexpr double kDecoding = 2.22;
constexpr double kPartProjected = 121;
constexpr double kWalker = 7.54e3;
constexpr double kPartPosed = 60;
constexpr double kFrame = 1.23e5;

// Of MoveNet Lightning on one thread, measured by hand.
constexpr double kNetworkLook = 14e6;

// Share of the moves that the first camera's likelihood accepts (filter/particle_filter.h).
constexpr double kPassed = 0.57;

// Mean number of layers in a frame with one, two and three cameras.
constexpr std::array<double, 3> kLayers{3.9, 4.7, 4.9};

constexpr double kMsPerNs = 1e-6;

Costs camera_cost(const FrameWork& work, const CameraWork& camera, double poses) {
  Costs out{{"decoding", kMsPerNs * kDecoding * camera.filmed_px}};
  if (camera.looks > 0) out.emplace_back("pose network", kMsPerNs * kNetworkLook * camera.looks);
  bool weighs = false;
  Terms::each([&]<typename Term>() {
    const TermWork asked{camera.region_px, camera.rows, poses, work.parts, work.classes};
    for (const TermCost& cost : Term::cost(work.terms, asked)) {
      weighs = true;
      out.emplace_back(cost.what, kMsPerNs * cost.cpu_ns);
    }
  });
  if (weighs) out.emplace_back("projection", kMsPerNs * kPartProjected * poses * work.parts);
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

double sum(const Costs& costs) {
  double total = 0;
  for (const auto& [what, ms] : costs) total += ms;
  return total;
}

double FrameCost::sum() const {
  double total = walker + poses;
  for (const Costs& camera : cameras) total += walktrack::sum(camera);
  return total;
}

double usual_layers(int cameras, int max_layers) {
  const size_t many = std::min(static_cast<size_t>(std::max(cameras, 1)), kLayers.size());
  return std::min(kLayers[many - 1], static_cast<double>(max_layers));
}

}  // namespace jobs
}  // namespace walktrack
