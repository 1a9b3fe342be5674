// Measures the scenes of the regression suite anew, writes their bands and prints what changed as a
// Markdown table: scripts/refresh_bands.sh. Arguments name the scenes to refresh; none: all.
#include <algorithm>
#include <cstdio>
#include <exception>
#include <set>

#include <fmt/format.h>

#include "io/archive/files.h"
#include "tests/regression/suite.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

// The bands with those of one scene replaced.
std::vector<Band> replaced(const std::vector<Band>& bands, const std::string& scene,
                           const std::vector<Band>& of_scene) {
  std::vector<Band> out;
  for (const Band& band : bands)
    if (band.scene != scene) out.push_back(band);
  out.insert(out.end(), of_scene.begin(), of_scene.end());
  std::stable_sort(out.begin(), out.end(),
                   [](const Band& a, const Band& b) { return a.scene < b.scene; });
  return out;
}

// Each scene is written when it is measured, so that nothing is lost if this is stopped.
void refresh(const std::set<std::string>& wanted) {
  const TemporaryFolder folder;
  std::vector<Band> before;
  if (std::filesystem::exists(bands_file())) before = read_bands(bands_file());
  std::vector<Band> now = before;
  for (const SuiteScene& scene : suite_scenes()) {
    const std::string name(scene.name);
    if (!wanted.empty() && !wanted.contains(name)) continue;
    fmt::print(stderr, "{}\n", name);
    const auto runs = values_of(suite_results(name, kBandSeeds, folder.path()));
    now = replaced(now, name, bands_from({{name, runs}}));
    write_file_atomically(bands_file(), bands_csv(now));
  }
  fmt::print("{}", bands_difference(before, read_bands(bands_file())));
}

}  // namespace
}  // namespace walktrack

int main(int argc, char** argv) {
  try {
    walktrack::refresh({argv + 1, argv + argc});
    return 0;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
