#include "metrics/statistics/pareto.h"

#include <algorithm>
#include <cmath>

namespace walktrack {
inline namespace metrics {

namespace {

bool both_known(const Trade& trade) { return !std::isnan(trade.cost) && !std::isnan(trade.error); }

bool beats(const Trade& a, const Trade& b) {
  return a.cost <= b.cost && a.error <= b.error && (a.cost < b.cost || a.error < b.error);
}

}  // namespace

std::vector<bool> pareto_front(std::span<const Trade> trades) {
  std::vector<bool> front;
  for (const Trade& trade : trades)
    front.push_back(both_known(trade) &&
                    std::none_of(trades.begin(), trades.end(),
                                 [&](const Trade& other) { return beats(other, trade); }));
  return front;
}

}  // namespace metrics
}  // namespace walktrack
