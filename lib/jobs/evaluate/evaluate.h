// `walktrack evaluate`: compares estimates with a truth, as one list of named numbers for each
// estimate.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "io/drawing/error_plot.h"
#include "jobs/evaluate/figures.h"

namespace walktrack {
inline namespace jobs {

struct EvaluatedEstimate {
  std::string name;
  std::vector<Figure> figures;
  std::optional<ErrorSeries> series;  // for a truth of joints
};

// Numbers by rows, estimates by columns; cells are empty if an estimate lacks the key.
std::string as_markdown(const std::string& truth_name, const std::vector<EvaluatedEstimate>& all);
std::string as_json(const std::string& truth_name, const std::vector<EvaluatedEstimate>& all);

// The errors as a plot (io/drawing/error_plot.h). UsageError for a truth without joints.
std::string as_svg(const std::string& truth_name, const std::vector<EvaluatedEstimate>& all);

struct EvaluateJob {
  std::filesystem::path truth;  // a kinetics.csv beside it is used as the truth of forces
  // joints.csv files, or result folders of `track` that contain one. An uncertainty.csv beside it
  // is used if the truth has joints, a kinetics.csv if there is a truth of forces.
  std::vector<std::filesystem::path> estimates;
  std::optional<std::filesystem::path> uncertainty;  // used instead, for a single estimate
  std::optional<double> frame_rate;  // Hz, of the truth's frames; otherwise the estimate's rate
};

std::vector<EvaluatedEstimate> evaluate(const EvaluateJob& job);

}  // namespace jobs
}  // namespace walktrack
