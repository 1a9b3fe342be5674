// Roots of small polynomials in the unit interval, found between the roots of their derivatives, so
// that no root is missed, however close two of them are.
#pragma once

#include <array>
#include <optional>

namespace walktrack {
inline namespace synth {

// c[0] + c[1] u + c[2] u^2 + c[3] u^3 + c[4] u^4.
using Quartic = std::array<double, 5>;

// The smallest u in [0, 1] at which the quartic changes from positive to zero, to about 1e-15. A
// quartic that is <= 0 at 0 has no such root before it has been positive.
std::optional<double> first_descent(const Quartic& quartic);

}  // namespace synth
}  // namespace walktrack
