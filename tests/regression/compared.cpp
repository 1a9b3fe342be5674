#include "tests/regression/compared.h"

#include <functional>
#include <map>
#include <string>

#include "tests/run_program.h"

namespace walktrack {

const std::filesystem::path& compared_folder() {
  static const TemporaryFolder folder;
  return folder.path();
}

const std::vector<SuiteResult>& compared_results(std::string_view name) {
  static std::map<std::string, std::vector<SuiteResult>, std::less<>> known;
  auto found = known.find(name);
  if (found == known.end())
    found = known.emplace(std::string(name), suite_results(name, kComparedSeeds, compared_folder()))
                .first;
  return found->second;
}

}  // namespace walktrack
