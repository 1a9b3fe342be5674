// The Pareto front of cost and error: the measured settings for which no other setting has at most
// the same cost and at most the same error, and is better in one of the two.
#pragma once

#include <span>
#include <vector>

namespace walktrack {
inline namespace metrics {

struct Trade {
  double cost, error;  // any units; smaller is better
};

// For each setting. Equal settings are on the front together; a setting with a NaN is not on it,
// and excludes no other one.
std::vector<bool> pareto_front(std::span<const Trade> trades);

}  // namespace metrics
}  // namespace walktrack
