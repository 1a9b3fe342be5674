#include "metrics/statistics/pareto.h"

#include <cmath>
#include <limits>

#include <gtest/gtest.h>

#include "core/rng.h"

namespace walktrack {
namespace {

constexpr double kNone = std::numeric_limits<double>::quiet_NaN();

struct Case {
  const char* what;
  std::vector<Trade> trades;
  std::vector<bool> front;
};

TEST(ParetoFront, EdgeCases) {
  const std::vector<Case> cases{
      {"nothing", {}, {}},
      {"one", {{1, 1}}, {true}},
      {"better in both", {{1, 1}, {2, 2}}, {true, false}},
      {"each better in one", {{1, 2}, {2, 1}}, {true, true}},
      {"same cost, less error", {{1, 2}, {1, 1}}, {false, true}},
      {"same error, less cost", {{2, 1}, {1, 1}}, {false, true}},
      {"equal ones stand together", {{1, 1}, {1, 1}}, {true, true}},
      {"unknown neither stands nor beats", {{1, kNone}, {2, 2}, {kNone, 0}}, {false, true, false}},
      {"infinitely bad is beaten", {{1, HUGE_VAL}, {1, 5}}, {false, true}},
  };
  for (const Case& each : cases) EXPECT_EQ(pareto_front(each.trades), each.front) << each.what;
}

// Sorted by cost, the errors of a front decrease, and for every setting off the front there is a
// better one on it.
TEST(ParetoFront, OfRandomTradesFallsAndBeatsTheRest) {
  Rng rng(1, Purpose::kTest, 0);
  std::vector<Trade> trades(200);
  for (Trade& trade : trades) trade = {rng.uniform(), rng.uniform()};
  const std::vector<bool> front = pareto_front(trades);
  for (size_t i = 0; i < trades.size(); ++i) {
    bool beaten = false;
    for (size_t k = 0; k < trades.size(); ++k) {
      if (!front[k] || k == i) continue;
      beaten = beaten || (trades[k].cost < trades[i].cost && trades[k].error < trades[i].error);
    }
    EXPECT_EQ(beaten, !front[i]) << i;
  }
}

}  // namespace
}  // namespace walktrack
