// The regression suite: small scenes, rendered when they are needed, tracked with few particles and
// measured. README.md says how it is used.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "body/motion.h"
#include "jobs/evaluate/evaluate.h"
#include "jobs/track/track.h"
#include "metrics/statistics/coverage.h"
#include "tests/regression/bands.h"
#include "tests/regression/clip.h"

namespace walktrack {

struct SuiteScene {
  std::string_view name;  // scenes/<name>.yaml, and <name>.track.yaml if it is tracked differently
  bool fast;              // in the subset that every test run does
  std::optional<Clip> clip = {};  // a real one, not rendered
};

bool is_there(const SuiteScene& scene);

std::span<const SuiteScene> suite_scenes();

std::filesystem::path bands_file();
std::filesystem::path excuses_file();  // worse.csv

// The scene file of a clip; of a made scene, which is rendered below `folder` unless it is there.
std::filesystem::path rendered_scene(std::string_view name, const std::filesystem::path& folder);

// The job that tracks a scene into `output` the suite's way.
TrackJob suite_job(std::string_view name, const std::filesystem::path& scene, uint64_t seed,
                   const std::filesystem::path& output);

// A result and its reference.
struct SuiteResult {
  std::optional<Truth> truth;  // that `evaluate` knows
  Motion estimate;
  JointUncertainty uncertainty;
  double log_evidence = 0;  // nats, median over tracked frames
  std::string digest;
  std::optional<ClipFacts> clip = {};
};

SuiteResult tracked(const TrackJob& job, const std::optional<Clip>& clip = {});

// Seeds 1 to `seeds` of a scene.
std::vector<SuiteResult> suite_results(std::string_view name, size_t seeds,
                                       const std::filesystem::path& folder);

// The results of `evaluate`, and the other watched values.
FigureValues values_of(const SuiteResult& result);
std::vector<FigureValues> values_of(const std::vector<SuiteResult>& results);

}  // namespace walktrack
