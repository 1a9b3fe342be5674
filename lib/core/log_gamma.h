// The logarithm of the gamma function, thread-safe: std::lgamma writes a global variable.
#pragma once

#include <math.h>

namespace walktrack {
inline namespace core {

// log |gamma(x)|.
inline double log_gamma(double x) {
  int sign = 0;
  return ::lgamma_r(x, &sign);
}

}  // namespace core
}  // namespace walktrack
