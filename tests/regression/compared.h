// The results that this program's tests compare with bands, with each scene tracked once.
#pragma once

#include <string_view>
#include <vector>

#include "tests/regression/suite.h"

namespace walktrack {

// Seeds 1 to kComparedSeeds.
const std::vector<SuiteResult>& compared_results(std::string_view name);

// The folder of the rendered scenes; removed at the end.
const std::filesystem::path& compared_folder();

}  // namespace walktrack
