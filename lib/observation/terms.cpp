#include "observation/terms.h"

namespace walktrack {
inline namespace observation {

std::vector<TermSwitch> term_switches() {
  std::vector<TermSwitch> out;
  Terms::each([&]<typename Term>() {
    out.insert(out.end(), Term::kSwitches.begin(), Term::kSwitches.end());
  });
  return out;
}

}  // namespace observation
}  // namespace walktrack
