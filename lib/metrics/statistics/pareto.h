// What nothing beats: of measured trades of cost for error, those with no other that costs at most
// as much and errs at most as much, and does better in one of the two.
#pragma once

#include <span>
#include <vector>

namespace walktrack {
inline namespace metrics {

struct Trade {
  double cost, error;  // any units; smaller is better
};

// By trade. Equal trades are on the front together; one with a NaN never is, and beats nothing.
std::vector<bool> pareto_front(std::span<const Trade> trades);

}  // namespace metrics
}  // namespace walktrack
