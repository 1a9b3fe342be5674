// What a camera might see, without one.
#pragma once

#include <cmath>
#include <vector>

#include "observation/observer.h"

namespace walktrack {

inline constexpr int kEvidenceWidth = 320, kEvidenceHeight = 240;

// Pixels that speak for a body, some more than others, and on request stripes that move to the
// right.
inline CameraEvidence made_evidence(double nats, bool flow) {
  CameraEvidence out;
  resize(out.planes, {0, 0, kEvidenceWidth, kEvidenceHeight}, 1);
  std::vector<float> row(kEvidenceWidth);
  for (int y = 0; y < kEvidenceHeight; ++y) {
    for (int x = 0; x < kEvidenceWidth; ++x)
      row[static_cast<size_t>(x)] = static_cast<float>(nats * ((x + 3 * y) % 17 - 8) / 8.0);
    set_row(out.planes, 0, y, row, 4);
  }
  if (!flow) return out;
  out.flow.area = {0, 0, kEvidenceWidth, kEvidenceHeight};
  const auto stripe = [](int x) { return 100 + 10 * std::sin(0.3F * static_cast<float>(x)); };
  for (int y = 0; y < kEvidenceHeight; ++y)
    for (int x = 0; x < kEvidenceWidth; ++x)
      out.flow.pixels.push_back({stripe(x - 2), stripe(x), 0.05F});
  return out;
}

}  // namespace walktrack
