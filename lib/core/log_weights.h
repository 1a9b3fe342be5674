// Weights of particles as logarithms: image likelihoods differ by thousands of nats, which exceeds
// the range of double. -infinity is a valid weight (a dead particle); NaN and +infinity are errors
// of the caller.
#pragma once

#include <span>
#include <vector>

namespace walktrack {
inline namespace core {

// log(sum_i exp(w_i)), exact for any offset; -infinity for an empty or all-dead set.
double log_sum_exp(std::span<const double> log_weights);

// exp(w_i) / sum exp(w). All zeros when every weight is -infinity.
std::vector<double> normalised_weights(std::span<const double> log_weights);

// Effective sample size 1 / sum p_i^2 of the normalised weights (Kong, Liu & Wong 1994); 0 when all
// are dead.
double effective_sample_size(std::span<const double> log_weights);

// Effective sample size of weights raised to `exponent`, from which annealing chooses its layers.
double effective_sample_size(std::span<const double> log_weights, double exponent);

}  // namespace core
}  // namespace walktrack
