// Systematic resampling (Kitagawa 1996): one uniform draw, N equally spaced pointers into the
// cumulative weights. Unbiased: particle i is chosen N * p_i times on average, and the number
// differs from that by less than one.
#pragma once

#include <cstdint>
#include <span>

namespace walktrack {
inline namespace filter {

// Fills `parents` with indices into `log_weights`, in ascending order. `u` lies in (0, 1). The
// number of parents may differ from the number of weights. Returns false, leaving `parents` alone,
// when every weight is -infinity.
bool systematic_resample(std::span<const double> log_weights, double u,
                         std::span<uint32_t> parents);

}  // namespace filter
}  // namespace walktrack
