#include "jobs/simulate/stability.h"

#include <algorithm>
#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/conventions.h"
#include "core/parallel_for.h"
#include "walker/model_spec.h"
#include "walker/simulate.h"

namespace walktrack {
inline namespace jobs {
namespace {

struct Scenario {
  std::string name;
  ModelSpec model;
};

constexpr std::array kIntegrators{Integrator::kEuler, Integrator::kRk4, Integrator::kMidpoint};

ModelSpec with_stiffness(double factor) {
  ModelSpec model = default_model("kneed");
  for (SpringDamper* spring : {&model.controls.torso, &model.controls.hip,
                               &model.controls.stance_knee, &model.controls.swing_knee}) {
    spring->stiffness *= factor;
  }
  return model;
}

ModelSpec with_shanks(double factor) {
  ModelSpec model = default_model("kneed");
  model.kneed.shank.mass *= factor;
  model.kneed.shank.inertia *= factor;
  return model;
}

ModelSpec on_slope(double degrees) {
  ModelSpec model = default_model("kneed");
  model.kneed.slope = rad_from_deg(degrees);
  return model;
}

// Both legs straight and all rates zero, except for a rate that the legs have in common.
ModelSpec straight(double stance, double swing, double rate) {
  ModelSpec model = default_model("kneed");
  model.start.q = {0, stance, swing, stance, swing};
  model.start.qd = {0, rate, rate, rate, rate};
  return model;
}

std::vector<Scenario> scenarios() {
  return {{"nominal", default_model("kneed")},      {"stiffness x 1e-3", with_stiffness(1e-3)},
          {"stiffness x 1e3", with_stiffness(1e3)}, {"shank mass x 1e-6", with_shanks(1e-6)},
          {"shank mass x 1e-3", with_shanks(1e-3)}, {"shank mass x 1e3", with_shanks(1e3)},
          {"shank mass x 1e6", with_shanks(1e6)},   {"slope +45 deg", on_slope(45)},
          {"slope -45 deg", on_slope(-45)},         {"straight knees", straight(-.3, .3, 1)},
          {"feet in one place", straight(0, 0, .5)}};
}

WalkerState run(const ModelSpec& model, Integrator integrator, double step, double duration) {
  const auto walker = make_walker(model);
  const Eigen::VectorXd x = start_point(model, *walker);
  const Eigen::Index n = x.size() / 2;
  WalkerState state = walker->section_state(x.head(n), x.tail(n));
  std::vector<WalkerEvent> events;
  const SimulationOptions options{.integrator = integrator, .max_step = step};
  while (state.health == Health::kSound && state.time < duration) {
    if (!advance(*walker, state, duration - state.time, options, events)) break;
  }
  return state;
}

// Largest difference of an angle, and of the time if both walkers fell; -1 if they cannot be
// compared.
double difference(const WalkerState& a, const WalkerState& b) {
  if (a.health != b.health || a.q.size() != b.q.size()) return -1;
  return std::max((a.q - b.q).cwiseAbs().maxCoeff(), std::abs(a.time - b.time));
}

const char* name_of(Integrator integrator) {
  switch (integrator) {
    case Integrator::kEuler:
      return "euler";
    case Integrator::kRk4:
      return "rk4";
    case Integrator::kMidpoint:
      break;
  }
  return "midpoint";
}

}  // namespace

std::vector<StabilityRow> stability_table(const StabilityJob& job) {
  const std::vector<Scenario> all = scenarios();
  std::vector<WalkerState> references(all.size());
  parallel_for(all.size(), job.threads, [&](size_t i) {
    references[i] = run(all[i].model, Integrator::kRk4, job.reference_step, job.duration);
    if (references[i].health == Health::kDiverged) {
      references[i] = run(all[i].model, Integrator::kMidpoint, job.reference_step, job.duration);
    }
  });
  const size_t columns = job.steps.size();
  std::vector<StabilityRow> rows;
  for (const Scenario& scenario : all) {
    for (const Integrator integrator : kIntegrators) {
      rows.push_back({scenario.name, integrator, std::vector<std::string>(columns),
                      std::vector<double>(columns, -1)});
    }
  }
  parallel_for(rows.size() * columns, job.threads, [&](size_t cell) {
    StabilityRow& row = rows[cell / columns];
    const size_t scenario = cell / columns / kIntegrators.size(), column = cell % columns;
    const WalkerState end =
        run(all[scenario].model, row.integrator, job.steps[column], job.duration);
    std::string& word = row.words[column];
    if (end.health == Health::kDiverged) {
      word = "diverged";
      return;
    }
    row.errors[column] = difference(end, references[scenario]);
    const bool close = row.errors[column] >= 0 && row.errors[column] <= job.tolerance;
    word = close ? "accurate" : "degraded";
  });
  return rows;
}

std::string stability_csv(const StabilityJob& job, const std::vector<StabilityRow>& rows) {
  std::string csv = "scenario,integrator";
  for (const double step : job.steps) csv += fmt::format(",step_{0:.3g},error_{0:.3g}", step);
  csv += '\n';
  for (const StabilityRow& row : rows) {
    csv += row.scenario + "," + name_of(row.integrator);
    for (size_t i = 0; i < row.words.size(); ++i) {
      csv += "," + row.words[i] + ",";
      if (row.errors[i] >= 0) csv += fmt::format("{:.2g}", row.errors[i]);
    }
    csv += '\n';
  }
  return csv;
}

}  // namespace jobs
}  // namespace walktrack
