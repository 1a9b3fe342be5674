// Roots of small polynomials in the unit interval, found between the roots of their derivatives:
// no root is missed or invented, however close two of them lie.
#pragma once

#include <array>
#include <optional>

namespace walktrack {
inline namespace synth {

// c[0] + c[1] u + c[2] u^2 + c[3] u^3 + c[4] u^4.
using Quartic = std::array<double, 5>;

// The smallest u in [0, 1] at which the quartic comes down to zero from above, to about 1e-15. A
// quartic that is already <= 0 at 0 has none before it has been positive.
std::optional<double> first_descent(const Quartic& quartic);

}  // namespace synth
}  // namespace walktrack
