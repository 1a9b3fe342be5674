#include "core/version.h"

namespace walktrack {
inline namespace core {

const BuildFacts& build_facts() {
  static constexpr BuildFacts kFacts{WALKTRACK_VERSION, WALKTRACK_COMMIT, WALKTRACK_BUILD_TYPE,
                                     WALKTRACK_COMPILER};
  return kFacts;
}

}  // namespace core
}  // namespace walktrack
