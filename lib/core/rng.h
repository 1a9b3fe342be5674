// Counter-based random numbers (Philox4x32-10; Salmon, Moraes, Dror & Shaw, "Parallel random
// numbers: as easy as 1, 2, 3", SC 2011). A stream is a pure function of its key, so a draw never
// depends on how many threads there are or in which order they run.
//
// Uniform and normal variates are generated here, because those of the standard library differ
// between vendors.
#pragma once

#include <array>
#include <cstdint>

namespace walktrack {
inline namespace core {

// Ten rounds of Philox on one 128-bit counter and a 64-bit key.
std::array<uint32_t, 4> philox4x32(std::array<uint32_t, 4> counter, std::array<uint32_t, 2> key);

// The purpose of a stream. Streams with different purposes are independent.
enum class Purpose : uint32_t {
  kResampling = 1,
  kInitialisation,
  kControls,
  kTorque,
  kMoves = 6,
  kTrajectory,
  kRendering = 8,
  kModelError,
  kTest = 10,
};

// A stream keyed by (seed, purpose, frame, index). Copying a stream copies its position.
class Rng {
 public:
  Rng(uint64_t seed, Purpose purpose, uint32_t frame = 0, uint32_t index = 0);

  uint32_t next();
  // Uniform on the open interval (0, 1), 53 random bits.
  double uniform();
  // Standard normal (Box-Muller, both values used).
  double normal();
  // Standard normal given that it lies in [-limit, limit], limit >= 0.5, by rejection.
  double truncated_normal(double limit);

 private:
  std::array<uint32_t, 2> key_;
  std::array<uint32_t, 4> counter_;
  std::array<uint32_t, 4> block_{};
  int used_ = 4;
  double spare_normal_ = 0;
  bool has_spare_ = false;
};

}  // namespace core
}  // namespace walktrack
