#include "jobs/prior.h"

#include <array>
#include <cmath>

#include <fmt/format.h>

#include "core/errors.h"
#include "core/parallel_for.h"
#include "core/version.h"
#include "gait/prior_file.h"
#include "gait/survival.h"
#include "io/files.h"
#include "jobs/prior_pictures.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMaxPriorBytes = 100'000'000;
constexpr double kRestingPower = 2.02;      // W/kg, standing metabolism (Ralston 1958)
constexpr double kMuscleEfficiency = 0.25;  // of positive work

GaitPrior read_prior(const fs::path& path) {
  return parse_gait_prior(read_text_file(path, kMaxPriorBytes), path.string());
}

int thread_count(int threads) { return threads > 0 ? threads : hardware_threads(); }

std::string gaits_table(const GaitPrior& prior, const WalkerUnits& units) {
  std::string out =
      "speed,step_length,slope,period,cyclic,valid,cost_of_transport,clearance_mm,"
      "swing_knee_deg,stance_knee_deg,largest_multiplier\n";
  for (size_t i = 0; i < prior.speeds.size(); ++i)
    for (size_t j = 0; j < prior.ratios.size(); ++j)
      for (size_t k = 0; k < prior.slopes.size(); ++k) {
        const GaitNode& n = prior.node(i, j, k);
        const double speed = prior.speeds[i] * units.speed();
        const double step = prior.ratios[j] * preferred_step_length(prior.speeds[i]) * units.length;
        constexpr double kDegrees = 57.29577951308232;
        out += fmt::format(
            "{:.4f},{:.4f},{:.4f},{:.4f},{:d},{:d},{:.4f},{:.1f},{:.1f},{:.1f},"
            "{:.3f}\n",
            speed, step, prior.slopes[k], step / speed, n.cyclic, n.valid, n.cost_of_transport,
            1000 * n.clearance * units.length, n.swing_flexion * kDegrees,
            n.stance_flexion * kDegrees, n.multiplier);
      }
  return out;
}

std::string survival_table(const GaitPrior& prior, const PriorReportJob& job,
                           const JobControl& control) {
  const KneedParameters walker = adult_walker(job.height, job.mass);
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

// The cheapest gait of every speed, and what it costs with resting power and muscles' efficiency.
std::string cheapest_table(const std::vector<CheapestStep>& steps, double gravity) {
  std::string out = "speed,step_length,cost_of_transport,metabolic_j_per_kg_m\n";
  for (const CheapestStep& s : steps)
    out += fmt::format("{:.4f},{:.4f},{:.4f},{:.3f}\n", s.speed, s.step_length, s.cost,
                       s.cost * gravity / kMuscleEfficiency + kRestingPower / s.speed);
  return out;
}

}  // namespace

bool build_prior(const PriorJob& job, const JobControl& control) {
  refuse_existing(job.output, job.overwrite);
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
  refuse_existing(job.output / "gaits.csv", job.overwrite);
  const GaitPrior prior = job.prior.empty() ? load_gait_prior() : read_prior(job.prior);
  const KneedParameters walker = adult_walker(job.height, job.mass);
  const WalkerUnits units = walker_units(walker);
  const auto steps = cheapest_steps(prior, units);
  fs::create_directories(job.output);
  write_file_atomically(job.output / "cost.svg", cost_picture(prior, units));
  write_file_atomically(job.output / "cheapest.csv", cheapest_table(steps, units.gravity));
  write_file_atomically(job.output / "cheapest_step.svg", cheapest_picture(steps, units));
  write_file_atomically(job.output / "strips.svg", strips_picture(prior, walker));
  write_file_atomically(job.output / "survival.csv", survival_table(prior, job, control));
  if (control.stopping()) return;
  write_file_atomically(job.output / "gaits.csv", gaits_table(prior, units));
}

}  // namespace walktrack
