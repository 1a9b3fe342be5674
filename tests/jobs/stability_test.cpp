#include "jobs/simulate/stability.h"

#include <cmath>
#include <set>

#include <gtest/gtest.h>

namespace walktrack {
namespace {

TEST(StabilityJob, EveryCellIsOneOfThreeWords) {
  StabilityJob job;
  job.steps = {1e-3, 1.0 / 60, 1.0 / 15};
  job.reference_step = 5e-4;
  job.threads = 2;
  const auto rows = stability_table(job);
  EXPECT_EQ(rows.size(), 33u);
  std::set<std::string> words;
  for (const StabilityRow& row : rows) {
    for (size_t i = 0; i < row.words.size(); ++i) {
      words.insert(row.words[i]);
      EXPECT_TRUE(std::isfinite(row.errors[i]));
    }
  }
  EXPECT_EQ(words, (std::set<std::string>{"accurate", "degraded", "diverged"}));
  EXPECT_EQ(rows[1].scenario, "nominal");
  EXPECT_EQ(rows[1].integrator, Integrator::kRk4);
  EXPECT_EQ(rows[1].words[0], "accurate");
  EXPECT_NE(stability_csv(job, rows).find("nominal,rk4,accurate"), std::string::npos);
}

}  // namespace
}  // namespace walktrack
