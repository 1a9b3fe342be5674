// The three motion models on a scene of the suite. Their accuracy is in
// lib/tracker/reports/physics.md.
#include <string>

#include <gtest/gtest.h>

#include "tests/regression/compared.h"

namespace walktrack {
namespace {

constexpr const char* kScene = "three_cameras";

TrackJob job_with(const char* model, uint64_t seed) {
  const auto scene = rendered_scene(kScene, compared_folder());
  TrackJob job = suite_job(kScene, scene, seed, compared_folder() / "models");
  apply_setting(job.config, std::string("motion.model=") + model, "test");
  return job;
}

// Only the position and the velocity of the subject are tested; the legs may be swapped, which
// physics prevents.
TEST(MotionModels, EachFollowsAClearWalk) {
  for (const char* model : {"anthropomorphic", "markov"}) {
    FigureValues values = values_of(tracked(job_with(model, 1)));
    EXPECT_EQ(values["filled_percent"], 100) << model;
    // Less than half a foot's length; three seeds of each model are within 35 mm and 0.05 m/s.
    EXPECT_NEAR(values["offset_along_mm"], 0, 100) << model;
    EXPECT_NEAR(values["offset_left_mm"], 0, 100) << model;
    EXPECT_NEAR(values["speed_error_m_s"], 0, 0.1) << model;
  }
}

TEST(MotionModels, TheKneedWalkerIsTheDefault) {
  EXPECT_EQ(tracked(job_with("kneed", 1)).digest, compared_results(kScene)[0].digest);
}

}  // namespace
}  // namespace walktrack
