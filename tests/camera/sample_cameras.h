// One camera for every lens model, for tests of projection.
#pragma once

#include <string>
#include <vector>

#include "tests/camera/made_camera.h"

namespace walktrack {

struct SampleCamera {
  std::string name;
  std::vector<double> coefficients;
  bool fisheye = false;
};

inline std::vector<SampleCamera> sample_lenses() {
  return {
      {"pinhole", {}},
      {"brown", {-0.25, 0.12, 1e-3, -2e-3, -0.03}},
      {"brown_four", {-0.12, 0.03, 5e-4, 1e-4}},
      {"rational", {0.4, -0.1, 1e-3, 5e-4, 0.02, 0.7, -0.05, 0.01}},
      {"prism", {-0.2, 0.05, 1e-3, 5e-4, 0, 0.01, 0, 0, 2e-3, -1e-3, -1e-3, 5e-4}},
      {"tilted", {-0.2, 0.05, 1e-3, 5e-4, 0, 0.01, 0, 0, 2e-3, -1e-3, 0, 0, 0.03, -0.02}},
      {"fisheye", {-0.02, 0.01, -0.004, 0.001}, true},
  };
}

// 3.2 m above the ground, 6 m from the origin, looking at it; 640 x 480.
inline Camera sample_camera(const SampleCamera& lens) {
  return looking_at(
      walktrack::lens({640, 480}, {520, 530}, {315, 245}, lens.coefficients, lens.fisheye),
      {1.0, -6.0, 3.2}, {0.2, 0, 1});
}

}  // namespace walktrack
