// The version of the program, for --version and run.json.
#pragma once

#include <string_view>

namespace walktrack {
inline namespace core {

struct BuildFacts {
  std::string_view version;
  std::string_view commit;  // "unknown" when built outside a repository
  std::string_view build_type;
  std::string_view compiler;
};

const BuildFacts& build_facts();

}  // namespace core
}  // namespace walktrack
