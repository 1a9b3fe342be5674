// The three motion models on a scene of the suite. What each is worth: lib/tracker/README.md.
#include <algorithm>

#include <gtest/gtest.h>

#include "camera/camera.h"
#include "metrics/joint_error.h"
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

double error_mm(const SuiteResult& result) { return values_of(result).at("joint_error_mean_mm"); }

TEST(MotionModels, EachTracksAClearWalk) {
  for (const char* model : {"anthropomorphic", "markov"}) {
    const SuiteResult result = tracked(job_with(model, 1));
    EXPECT_EQ(values_of(result).at("filled_percent"), 100) << model;
    // Half of a foot's length: who follows nothing, or with legs exchanged, is further off.
    EXPECT_LT(error_mm(result), 120) << model;
  }
}

TEST(MotionModels, TheKneedWalkerIsTheDefault) {
  EXPECT_EQ(tracked(job_with("kneed", 1)).digest, compared_results(kScene)[0].digest);
}

}  // namespace
}  // namespace walktrack
