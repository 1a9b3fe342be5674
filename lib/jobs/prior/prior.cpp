#include "jobs/prior/prior.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/conventions.h"
#include "core/errors.h"
#include "core/parallel_for.h"
#include "core/version.h"
#include "gait/prior/build_straight_prior.h"
#include "gait/prior/prior_file.h"
#include "gait/survival.h"
#include "io/archive/files.h"
#include "io/archive/result_folder.h"
#include "jobs/prior/prior_pictures.h"

namespace walktrack {
inline namespace jobs {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMaxPriorBytes = 100'000'000;
constexpr double kRestingPower = 2.02;      // W/kg, standing metabolism (Ralston 1958)
constexpr double kMuscleEfficiency = 0.25;  // of positive work

GaitPrior read_prior(const fs::path& path) {
  return parse_gait_prior(read_text_file(path, kMaxPriorBytes), path.string());
}

// One line for each node: its coordinates, then the result of line(node).
template <typename Node, typename Line>
std::string gaits_table(const PriorTable<Node>& prior, const WalkerUnits& units,
                        const std::string& columns, const Line& line) {
  std::string out = "speed,step_length,slope,period,cyclic,valid,cost_of_transport," + columns;
  for (size_t i = 0; i < prior.speeds.size(); ++i)
    for (size_t j = 0; j < prior.ratios.size(); ++j)
      for (size_t k = 0; k < prior.slopes.size(); ++k) {
        const Node& n = prior.node(i, j, k);
        const GaitTarget at = prior.target(i, j, k);
        out += fmt::format("\n{:.4f},{:.4f},{:.4f},{:.4f},{:d},{:d},{:.4f},{}",
                           at.speed * units.speed(), at.step_length * units.length, at.slope,
                           at.step_length / at.speed * units.time(), n.cyclic, n.valid,
                           n.cost_of_transport, line(n));
      }
  return out + "\n";
}

std::string gaits_table(const GaitPrior& prior, const WalkerUnits& units) {
  return gaits_table(prior, units, "clearance_mm,swing_knee_deg,stance_knee_deg,largest_multiplier",
                     [&](const GaitNode& n) {
                       return fmt::format("{:.1f},{:.1f},{:.1f},{:.3f}",
                                          1000 * n.clearance * units.length,
                                          deg_from_rad(n.swing_flexion),
                                          deg_from_rad(n.stance_flexion), n.multiplier);
                     });
}

std::string gaits_table(const StraightPrior& prior, const WalkerUnits& units) {
  return gaits_table(prior, units, "hip_stiffness,toe_off_impulse,least_normal,largest_multiplier",
                     [&](const StraightNode& n) {
                       return fmt::format("{:.4f},{:.4f},{:.3f},{:.3f}", n.gait[0] * units.torque(),
                                          n.gait[1] * units.impulse(), n.least_normal,
                                          n.multiplier);
                     });
}

template <typename Prior, typename Parameters>
std::string survival_table(const Prior& prior, const Parameters& walker, const PriorReportJob& job,
                           const JobControl& control) {
  constexpr std::array kSpeeds{0.8, 1.3, 1.8};
  constexpr std::array kNoises{0.02, 0.05, 0.10};
  constexpr std::array kFeedbacks{0.0, 1.0};
  std::string out = "speed,noise,feedback,alive_1s,alive_2s,alive_5s,alive_10s\n";
  size_t done = 0;
  for (const double speed : kSpeeds)
    for (const double noise : kNoises)
      for (const double feedback : kFeedbacks) {
        control.progress("walking", done++, kSpeeds.size() * kNoises.size() * kFeedbacks.size());
        if (control.stopping()) return out;
        const SurvivalTrial trial{.speed = speed,
                                  .noise = {.relative = noise, .rest = noise / 2, .torque = 0},
                                  .feedback = feedback,
                                  .walkers = job.walkers,
                                  .seed = job.seed};
        const auto alive = survival(prior, walker, trial, {1, 2, 5, 10}, thread_count(job.threads));
        out += fmt::format("{},{},{},{:.3f},{:.3f},{:.3f},{:.3f}\n", speed, noise, feedback,
                           alive[0], alive[1], alive[2], alive[3]);
      }
  return out;
}

// The gait of least cost at every speed, with the cost of resting power and the efficiency of
// muscles.
std::string cheapest_table(const std::vector<CheapestStep>& steps, double gravity) {
  std::string out = "speed,step_length,cost_of_transport,metabolic_j_per_kg_m\n";
  for (const CheapestStep& s : steps)
    out += fmt::format("{:.4f},{:.4f},{:.4f},{:.3f}\n", s.speed, s.step_length, s.cost,
                       s.cost * gravity / kMuscleEfficiency + kRestingPower / s.speed);
  return out;
}

constexpr const char* kGaitsFile = "gaits.csv";  // written last

Outputs outputs_of(const PriorReportJob& job) {
  return {
      job.output,
      "prior",
      {"cost.svg", "cheapest.csv", "cheapest_step.svg", "strips.svg", "survival.csv", kGaitsFile},
      {job.prior},
      kGaitsFile};
}

}  // namespace

bool build_prior(const PriorJob& job, const JobControl& control) {
  refuse_existing(job.output, job.overwrite);
  refuse_input(job.output, {job.earlier});
  fs::path part = job.output;
  part += ".part";
  GaitPrior earlier;
  if (fs::exists(part)) {
    control.say(fmt::format("going on from {}", part.string()));
    earlier = read_prior(part);
  } else if (!job.earlier.empty()) {
    earlier = read_prior(job.earlier);
  }
  const size_t size = job.grid.speeds.size() * job.grid.ratios.size() * job.grid.slopes.size();
  const auto keep = [&](const GaitPrior& prior, size_t tried) {
    write_file_atomically(part, gait_prior_text(prior, build_facts().version));
    control.progress("gaits", tried, size);
    return !control.stopping();
  };
  const GaitPrior prior = build_gait_prior(job.grid, earlier, thread_count(job.threads), keep);
  if (control.stopping()) return false;
  write_file_atomically(job.output, gait_prior_text(prior, build_facts().version));
  fs::remove(part);
  return true;
}

void report_prior(const PriorReportJob& job, const JobControl& control) {
  const GaitPrior prior = job.prior.empty() ? load_gait_prior() : read_prior(job.prior);
  const ResultFolder folder(outputs_of(job), job.overwrite);
  const KneedParameters walker = adult_walker(job.height, job.mass);
  const WalkerUnits units = walker_units(walker);
  const CostTable costs = cost_table(prior);
  const auto steps = cheapest_steps(costs, units);
  folder.write("cost.svg", cost_picture(costs, units));
  folder.write("cheapest.csv", cheapest_table(steps, units.gravity));
  folder.write("cheapest_step.svg", cheapest_picture(steps, units));
  folder.write("strips.svg", strips_picture(prior, walker));
  folder.write("survival.csv", survival_table(prior, walker, job, control));
  if (control.stopping()) return;
  folder.write(kGaitsFile, gaits_table(prior, units));
}

void build_straight_prior(const PriorJob& job, const JobControl& control) {
  refuse_existing(job.output, job.overwrite);
  StraightPriorGrid grid;
  grid.slopes = job.grid.slopes;
  const StraightPrior prior = build_straight_prior(grid, [&](size_t solved) {
    control.progress("gaits", solved, grid.size());
    return true;
  });
  write_file_atomically(job.output, straight_prior_text(prior, build_facts().version));
}

void report_straight_prior(const PriorReportJob& job, const JobControl& control) {
  const StraightPrior prior =
      job.prior.empty()
          ? load_straight_prior()
          : parse_straight_prior(read_text_file(job.prior, kMaxPriorBytes), job.prior.string());
  const ResultFolder folder(outputs_of(job), job.overwrite);
  const StraightLeggedParameters walker = adult_straight_walker(job.height, job.mass);
  const WalkerUnits units = walker_units(walker);
  folder.write("cost.svg", cost_picture(cost_table(prior), units));
  folder.write("survival.csv", survival_table(prior, walker, job, control));
  if (control.stopping()) return;
  folder.write(kGaitsFile, gaits_table(prior, units));
}

}  // namespace jobs
}  // namespace walktrack
