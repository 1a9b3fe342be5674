#include "jobs/simulate/simulate_cycle.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <memory>
#include <stdexcept>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "io/archive/files.h"
#include "io/scene/model_file.h"
#include "jobs/simulate/simulate_job.h"

namespace walktrack {
inline namespace jobs {
namespace {

using Eigen::VectorXd;
using Json = nlohmann::ordered_json;

ModelSpec with_value(ModelSpec model, const std::string& key, double value) {
  apply_model_setting(model, key + "=" + shortest_number(value));
  return model;
}

double value_of(ModelSpec model, const std::string& key) {
  for (const ModelEntry& entry : entries(model)) {
    if ((entry.key == key || entry.key == "parameters." + key) && entry.number) {
      return *entry.number;
    }
  }
  apply_model_setting(model, key + "=0");  // throws an error that names the nearest key
  throw std::runtime_error(key + " is no number that can be followed");
}

// The return map of one model, which owns its walker.
ReturnMap owned_map(std::shared_ptr<const Walker> walker, const GaitOptions& options) {
  return [walker, map = step_map(*walker, options)](const VectorXd& x) { return map(x); };
}

SectionRows owned_rows(std::shared_ptr<const Walker> walker) {
  return [walker, rows = section_rows(*walker)](const VectorXd& x) { return rows(x); };
}

VectorXd settled_guess(const Walker& walker, VectorXd x, const CycleJob& job) {
  const ReturnMap map = step_map(walker, job.options);
  for (int i = 0; i < job.settling_steps; ++i) {
    const auto next = map(x);
    if (!next) {
      throw std::runtime_error(
          fmt::format("no limit cycle: the walker falls in step {} from its start state", i + 1));
    }
    x = *next;
  }
  return x;
}

// Describes what happens to the initial guess, for the message if no cycle was found.
std::string fate_of(const Walker& walker, const VectorXd& guess, const GaitOptions& options) {
  const Eigen::Index n = guess.size() / 2;
  WalkerState state = walker.section_state(guess.head(n), guess.tail(n));
  std::vector<WalkerEvent> events;
  if (advance(walker, state, options.max_time, options.simulation, events)) {
    return fmt::format("its step ends {:.3g} away", (walker.section_point(state) - guess).norm());
  }
  if (state.health == Health::kFallen) return fmt::format("it falls after {:.3f} s", state.time);
  return state.health == Health::kDiverged ? "it diverges" : "it takes no step in time";
}

std::runtime_error no_cycle(const Walker& walker, const VectorXd& guess,
                            const GaitOptions& options) {
  return std::runtime_error("no limit cycle was reached from the guess: " +
                            fate_of(walker, guess, options));
}

// For a walker that conserves energy, Newton's method keeps the energy that is stated, otherwise
// that of the guess.
ModelSpec with_energy(ModelSpec model, const Walker& walker, const VectorXd& guess) {
  if (model.model == "monopode" && model.start.energy == 0) {
    const Eigen::Index n = guess.size() / 2;
    model.start.energy = walker.energy(walker.section_state(guess.head(n), guess.tail(n))).total();
  }
  return model;
}

SectionProjection onto_energy(const ModelSpec& model) {
  return [model](const VectorXd& x) { return at_energy(model, x); };
}

// The limit cycle of the model with the followed parameter at its goal. If it is lost, throws an
// error that states how far it was followed.
FollowedCycle followed(const CycleJob& job, const VectorXd& guess) {
  const auto model_at = [&](double value) { return with_value(job.model, job.follow_key, value); };
  const auto walker_at = [&](double value) {
    return std::shared_ptr<const Walker>(make_walker(model_at(value)));
  };
  const auto onto = [&](double value) { return onto_energy(model_at(value)); };
  const MapFamily family{[&](double value) { return owned_map(walker_at(value), job.options); },
                         [&](double value) { return owned_rows(walker_at(value)); }, onto};
  const double from = value_of(job.model, job.follow_key);
  FollowedCycle result = follow_limit_cycle(family, guess, from, job.follow_to, job.options.cycle);
  if (result.arrived) return result;
  if (!result.cycle) throw no_cycle(*make_walker(job.model), guess, job.options);
  throw std::runtime_error(fmt::format(
      "the limit cycle was lost on the way: the last one, at {} = {:.6g}, has a largest multiplier "
      "of {:.3f}",
      job.follow_key, result.reached, result.cycle->largest_multiplier()));
}

double largest_angular_momentum(const Walker& walker, WalkerState state,
                                const GaitOptions& options) {
  double largest = 0;
  std::vector<WalkerEvent> events;
  advance(walker, state, options.max_time, options.simulation, events, [&](const WalkerState& now) {
    largest = std::max(largest, std::abs(walker.momentum(now).angular));
  });
  return largest;
}

Json numbers(const VectorXd& values) { return std::vector<double>(values.begin(), values.end()); }

}  // namespace

FoundCycle find_cycle(const CycleJob& wanted) {
  FoundCycle found;
  CycleJob job = wanted;
  auto walker = make_walker(job.model);
  const VectorXd guess = settled_guess(*walker, start_point(job.model, *walker), job);
  job.model = with_energy(job.model, *walker, guess);
  found.model = job.model;
  LimitCycle cycle;
  if (job.follow_key.empty()) {
    const auto reached = find_limit_cycle(step_map(*walker, job.options), section_rows(*walker),
                                          guess, job.options.cycle, onto_energy(job.model));
    if (!reached) throw no_cycle(*walker, guess, job.options);
    cycle = *reached;
  } else {
    FollowedCycle there = followed(job, guess);
    cycle = *there.cycle;
    found.branch_changes = std::move(there.changes);
    found.followed_key = job.follow_key;
    found.model = with_value(job.model, job.follow_key, job.follow_to);
    walker = make_walker(found.model);
  }
  const auto gait = describe_cycle(*walker, cycle, job.options);
  if (!gait) throw std::runtime_error("the limit cycle that was found cannot be walked");
  found.gait = *gait;
  const Eigen::Index n = cycle.point.size() / 2;
  found.model.start.q.assign(cycle.point.begin(), cycle.point.begin() + n);
  found.model.start.qd.assign(cycle.point.begin() + n, cycle.point.end());
  found.model.start.energy = 0;
  found.weight = walker->weight();
  found.energy = walker->energy(gait->start).total();
  found.angular_momentum = largest_angular_momentum(*walker, gait->start, job.options);
  return found;
}

std::string cycle_json(const FoundCycle& found) {
  const GaitCycle& gait = found.gait;
  Json json{{"model", found.model.model},
            {"q", numbers(gait.start.q)},
            {"qd", numbers(gait.start.qd)},
            {"residual", gait.cycle.residual},
            {"iterations", gait.cycle.iterations},
            {"period", gait.step.period},
            {"speed", gait.speed},
            {"energy", found.energy},
            {"travel", gait.step.travel},
            {"step_length", gait.step.step_length},
            {"frequency", 1 / gait.step.period},
            {"cost_of_transport", gait.cost_of_transport},
            {"positive_work", gait.step.positive_work},
            {"lowest_ground_force", gait.step.lowest_normal},
            {"largest_angular_momentum", found.angular_momentum},
            {"stable", gait.cycle.is_stable()},
            {"largest_multiplier", gait.cycle.largest_multiplier()}};
  if (!found.followed_key.empty()) json["branch_changes"] = Json::array();
  for (const BranchChange& change : found.branch_changes) {
    json["branch_changes"].push_back({{"from", change.from}, {"to", change.to}});
  }
  for (const std::complex<double>& value : gait.cycle.multipliers) {
    json["multipliers"].push_back({{"re", value.real()}, {"im", value.imag()}});
  }
  for (const WalkerEvent& event : gait.step.events) {
    json["events"].push_back({{"t", event.time}, {"event", name_of(event.transition.kind)}});
  }
  return json.dump(2) + "\n";
}

std::string cycle_text(const FoundCycle& found) {
  const GaitCycle& gait = found.gait;
  std::string text = fmt::format("{}: {} limit cycle, |P(x) - x| = {:.1e} after {} iterations\n",
                                 found.model.model, gait.cycle.is_stable() ? "stable" : "unstable",
                                 gait.cycle.residual, gait.cycle.iterations);
  const auto list = [&](const char* name, const VectorXd& values) {
    text += fmt::format("  {:<24}", name);
    for (const double value : values) text += fmt::format(" {:.9f}", value);
    text += '\n';
  };
  list("coordinates", gait.start.q);
  list("rates", gait.start.qd);
  text += fmt::format("  {:<24} {:.7f} s\n", "period", gait.step.period);
  text += fmt::format("  {:<24} {:.6f} m/s\n", "speed", gait.speed);
  text += fmt::format("  {:<24} {:.9g} J\n", "energy", found.energy);
  text += fmt::format("  {:<24} {:.6f} m (body), {:.6f} m (between the feet)\n", "step",
                      gait.step.travel, gait.step.step_length);
  text += fmt::format("  {:<24} {:.5f}\n", "cost of transport", gait.cost_of_transport);
  text += fmt::format("  {:<24} {:.4f} of the weight\n", "lowest ground force",
                      gait.step.lowest_normal / found.weight);
  text += fmt::format("  {:<24} {:.5g} kg m^2/s about the centre of mass\n", "angular momentum",
                      found.angular_momentum);
  text += fmt::format("  {:<24}", "multipliers");
  for (const std::complex<double>& value : gait.cycle.multipliers) {
    text += value.imag() == 0 ? fmt::format(" {:.5f}", value.real())
                              : fmt::format(" {:.5f}{:+.5f}i", value.real(), value.imag());
  }
  text += '\n';
  for (const BranchChange& change : found.branch_changes) {
    text += fmt::format(
        "warning: between {} = {:.6g} and {:.6g} the cycle jumped to another branch: this one is "
        "no continuation of the cycle at the start\n",
        found.followed_key, change.from, change.to);
  }
  return text;
}

}  // namespace jobs
}  // namespace walktrack
