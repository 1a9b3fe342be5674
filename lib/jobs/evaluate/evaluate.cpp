#include "jobs/evaluate/evaluate.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/errors.h"
#include "io/tables/kinetics_file.h"
#include "io/tables/motion_file.h"
#include "metrics/joint_error.h"

namespace walktrack {
inline namespace jobs {

namespace {

namespace fs = std::filesystem;

const Figure* find(const EvaluatedEstimate& estimate, const std::string& key) {
  for (const Figure& figure : estimate.figures) {
    if (figure.key == key) return &figure;
  }
  return nullptr;
}

std::string cell(const Figure* figure) {
  if (!figure || std::isnan(figure->value)) return "-";
  return fmt::format("{:.{}f}", figure->value, figure->decimals);
}

// The keys of all estimates, in the order in which they first appear.
std::vector<Figure> all_rows(const std::vector<EvaluatedEstimate>& all) {
  std::vector<Figure> rows;
  for (const EvaluatedEstimate& estimate : all) {
    for (const Figure& figure : estimate.figures) {
      const bool known = std::any_of(rows.begin(), rows.end(),
                                     [&](const Figure& row) { return row.key == figure.key; });
      if (!known) rows.push_back(figure);
    }
  }
  return rows;
}

// A row of joints that no estimate has is left out.
bool empty_row(const std::vector<EvaluatedEstimate>& all, const std::string& key) {
  return std::all_of(all.begin(), all.end(), [&](const EvaluatedEstimate& estimate) {
    const Figure* figure = find(estimate, key);
    return !figure || std::isnan(figure->value);
  });
}

std::optional<JointUncertainty> uncertainty_of(const EvaluateJob& job, const fs::path& joints) {
  const fs::path beside = joints.parent_path() / "uncertainty.csv";
  if (job.uncertainty) return read_uncertainty(*job.uncertainty);
  if (!fs::exists(beside)) return std::nullopt;
  return read_uncertainty(beside);
}

std::optional<GroundForces> forces_beside(const fs::path& joints) {
  const fs::path file = joints.parent_path() / "kinetics.csv";
  if (!fs::exists(file)) return std::nullopt;
  return read_ground_forces(file);
}

ErrorSeries series_of(const std::string& name, const Motion& truth, const Motion& estimate,
                      const std::optional<JointUncertainty>& uncertainty) {
  constexpr double kMm = 1000;
  JointErrors errors = joint_errors(truth, estimate);
  ErrorSeries out{name, std::move(errors.time), std::move(errors.by_frame), {}, {}};
  if (uncertainty) out.coverage = coverage(truth, *uncertainty).scored;
  for (double& error : out.error_mm) error *= kMm;
  for (size_t j = 0; j < kJointCount; ++j) {
    const ErrorStatistics& joint = errors.by_joint[j].absolute;
    out.joint_mm[j] = joint.count > 0 ? kMm * joint.mean : std::nan("");
  }
  return out;
}

}  // namespace

std::string as_markdown(const std::string& truth_name, const std::vector<EvaluatedEstimate>& all) {
  size_t width = truth_name.size();
  const std::vector<Figure> rows = all_rows(all);
  for (const Figure& row : rows) width = std::max(width, row.label.size());
  std::string out = fmt::format("| {:<{}} |", truth_name, width);
  std::string rule = fmt::format("|{:-<{}}|", "", width + 2);
  for (const EvaluatedEstimate& estimate : all) {
    const size_t column = std::max<size_t>(estimate.name.size(), 8);
    out += fmt::format(" {:>{}} |", estimate.name, column);
    rule += fmt::format("{:->{}}:|", "", column + 1);
  }
  out += "\n" + rule + "\n";
  for (const Figure& row : rows) {
    if (row.detail || empty_row(all, row.key)) continue;
    out += fmt::format("| {:<{}} |", row.label, width);
    for (const EvaluatedEstimate& estimate : all) {
      const size_t column = std::max<size_t>(estimate.name.size(), 8);
      out += fmt::format(" {:>{}} |", cell(find(estimate, row.key)), column);
    }
    out += "\n";
  }
  return out;
}

std::string as_json(const std::string& truth_name, const std::vector<EvaluatedEstimate>& all) {
  nlohmann::ordered_json out;
  out["truth"] = truth_name;
  out["estimates"] = nlohmann::ordered_json::array();
  for (const EvaluatedEstimate& estimate : all) {
    nlohmann::ordered_json one;
    one["name"] = estimate.name;
    for (const Figure& figure : estimate.figures) {
      if (std::isnan(figure.value)) {
        one[figure.key] = nullptr;
      } else {
        one[figure.key] = figure.value;
      }
    }
    out["estimates"].push_back(std::move(one));
  }
  return out.dump(2) + "\n";
}

std::string as_svg(const std::string& truth_name, const std::vector<EvaluatedEstimate>& all) {
  std::vector<ErrorSeries> series;
  for (const EvaluatedEstimate& estimate : all) {
    if (!estimate.series)
      throw UsageError("the plot needs a truth of joints; " + truth_name + " has none");
    series.push_back(*estimate.series);
  }
  return error_plot_svg("Errors against " + truth_name, series);
}

std::vector<EvaluatedEstimate> evaluate(const EvaluateJob& job) {
  if (job.uncertainty && job.estimates.size() != 1)
    throw UsageError("--uncertainty goes with one estimate; with several, name their folders");
  const std::optional<GroundForces> true_forces = forces_beside(job.truth);
  std::vector<EvaluatedEstimate> out;
  for (const fs::path& given : job.estimates) {
    const fs::path file = fs::is_directory(given) ? given / "joints.csv" : given;
    const Motion estimate = read_motion(file);
    if (estimate.time.size() < 2)
      throw InputError(describe({file.string(), 0, ""}, "fewer than two rows", "a motion"));
    const double rate = job.frame_rate.value_or(1 / sample_period(estimate));
    const Truth truth = read_truth(job.truth, rate);
    const std::optional<JointUncertainty> uncertainty = uncertainty_of(job, file);
    out.push_back({given.string(), figures(truth, estimate, uncertainty), {}});
    const std::optional<GroundForces> forces = forces_beside(file);
    if (true_forces && forces) {
      for (Figure& figure : force_figures(*true_forces, *forces))
        out.back().figures.push_back(std::move(figure));
    }
    if (const Motion* joints = std::get_if<Motion>(&truth))
      out.back().series = series_of(given.string(), *joints, estimate, uncertainty);
  }
  return out;
}

}  // namespace jobs
}  // namespace walktrack
