// Measures the scenes of the regression suite again, writes their bands and prints the changes as a
// Markdown table: scripts/refresh_bands.sh. Arguments name the scenes to refresh; none: all. With
// --anew the scenes have changed, and their former values are not compared. Exit code 1: a value is
// worse than it once was, and worse.csv does not state the reason.
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

std::vector<Band> read_present() {
  return std::filesystem::exists(bands_file()) ? read_bands(bands_file()) : std::vector<Band>();
}

// Each scene is written as soon as it is measured, so that nothing is lost by an interruption.
bool refresh(std::set<std::string> wanted) {
  const bool anew = wanted.erase("--anew") > 0;
  const TemporaryFolder folder;
  const std::vector<Band> before = read_present();
  for (const SuiteScene& scene : suite_scenes()) {
    const std::string name(scene.name);
    if (!wanted.empty() && !wanted.contains(name)) continue;
    fmt::print(stderr, "{}{}\n", name, is_there(scene) ? "" : ": not here, left as it was");
    if (!is_there(scene)) continue;
    const auto runs = values_of(suite_results(name, kBandSeeds, folder.path()));
    const std::vector<Band> found = bands_from({{name, runs}});
    // Results that another process has measured meanwhile are kept.
    const std::vector<Band> now = read_present();
    write_file_atomically(bands_file(),
                          bands_csv(replaced(now, name, anew ? found : with_best(found, before))));
  }
  const std::vector<Band> after = read_present();
  fmt::print("{}", bands_difference(before, after));
  const auto worse = unexcused(after, read_excuses(excuses_file()));
  for (const std::string& line : worse) fmt::print(stderr, "{}\n", line);
  return worse.empty();
}

}  // namespace
}  // namespace walktrack

int main(int argc, char** argv) {
  try {
    return walktrack::refresh({argv + 1, argv + argc}) ? 0 : 1;
  } catch (const std::exception& error) {
    fmt::print(stderr, "{}\n", error.what());
    return 1;
  }
}
