// The whole table of extremes, a minute on one core: the report in lib/walker/reports shows the
// command's result.
#include <cmath>
#include <map>
#include <sstream>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "core/parallel_for.h"
#include "io/archive/files.h"
#include "jobs/simulate/stability.h"

namespace walktrack {
namespace {

std::vector<std::string> split(const std::string& text, char at) {
  std::istringstream stream(text);
  std::vector<std::string> parts;
  for (std::string part; std::getline(stream, part, at);) parts.push_back(part);
  return parts;
}

// "| nominal | a / a / a | ..." as scenario -> cells, each "a / a / a" over the integrators.
std::map<std::string, std::vector<std::string>> documented_table() {
  std::map<std::string, std::vector<std::string>> table;
  const std::string readme = read_text_file(
      std::string(WALKTRACK_SOURCE_DIR) + "/lib/walker/reports/integration_extremes.md", 1 << 20);
  for (const std::string& line : split(readme, '\n')) {
    const std::vector<std::string> cells = split(line, '|');
    if (cells.size() != 9 || cells[2].size() != 11) continue;
    std::vector<std::string>& row = table[cells[1].substr(1, cells[1].size() - 2)];
    for (size_t i = 2; i < cells.size(); ++i) row.push_back(cells[i].substr(1, 9));
  }
  return table;
}

char letter(const std::string& word) {
  if (word == "diverged") return 'x';
  return word == "accurate" ? 'a' : 'd';
}

TEST(StabilityTable, IsTheOneInTheReport) {
  StabilityJob job;
  job.threads = hardware_threads();
  const auto rows = stability_table(job);
  const auto documented = documented_table();
  ASSERT_EQ(rows.size(), 3 * documented.size());
  for (size_t i = 0; i < rows.size(); i += 3) {
    ASSERT_TRUE(documented.contains(rows[i].scenario)) << rows[i].scenario;
    for (size_t column = 0; column < job.steps.size(); ++column) {
      std::string cell;
      for (size_t k = 0; k < 3; ++k) {
        const StabilityRow& row = rows[i + k];
        EXPECT_TRUE(std::isfinite(row.errors[column]));
        cell += (k == 0 ? "" : " / ") + std::string(1, letter(row.words[column]));
      }
      EXPECT_EQ(cell, documented.at(rows[i].scenario).at(column))
          << rows[i].scenario << ", step " << job.steps[column];
    }
  }
}

}  // namespace
}  // namespace walktrack
