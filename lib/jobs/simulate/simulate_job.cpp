#include "jobs/simulate/simulate_job.h"

#include <algorithm>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/version.h"
#include "io/archive/files.h"
#include "io/archive/result_folder.h"
#include "io/drawing/picture.h"
#include "io/drawing/stick_figure.h"
#include "io/scene/model_file.h"

namespace walktrack {
inline namespace jobs {
namespace {

constexpr int kStripFigures = 12;

void add_cell(std::string& row, double value) { row += fmt::format(",{:.12g}", value + 0.0); }

void add_state(const Walker& walker, const WalkerState& state, size_t columns, std::string& csv) {
  csv += fmt::format("{:.12g},{}", state.time, state.phase);
  for (const Eigen::VectorXd& part : {state.q, state.qd}) {
    for (const double value : part) add_cell(csv, value);
    csv.append(columns - static_cast<size_t>(part.size()), ',');
  }
  const WalkerEnergy energy = walker.energy(state);
  for (const double value : {energy.kinetic, energy.gravity, energy.elastic, energy.total()}) {
    add_cell(csv, value);
  }
  Eigen::Vector2d ground = Eigen::Vector2d::Zero();
  for (const ContactForce& contact : walker.contact_forces(state)) ground += contact.force;
  const PlanarMomentum momentum = walker.momentum(state);
  for (const double value :
       {ground.x(), ground.y(), momentum.com.x(), momentum.com.y(), momentum.angular}) {
    add_cell(csv, value);
  }
  csv += '\n';
}

// The first recorded state at or after each wanted time.
std::vector<StickFigure> figures_at(const Walker& walker, const Recording& recording,
                                    double every) {
  std::vector<StickFigure> figures;
  double next = recording.states.front().time;
  for (const WalkerState& state : recording.states) {
    if (state.time < next) continue;
    StickFigure figure{state.time, walker.momentum(state).com.x(), {}};
    for (const Stroke& stroke : walker.strokes(state)) {
      figure.lines.push_back({stroke.from, stroke.to, stroke.group});
    }
    for (; next <= state.time; next += every) figures.push_back(figure);
  }
  return figures;
}

double slope_of(const ModelSpec& model) {
  if (model.model == "kneed") return model.kneed.slope;
  if (model.model == "anthropomorphic") return model.anthropomorphic.slope;
  return model.model == "rimless_wheel" ? model.rimless_wheel.slope : 0.0;
}

void write_pictures(const ResultFolder& folder, const Walker& walker, const SimulateJob& job,
                    const Recording& recording) {
  const double slope = slope_of(job.model);
  const double time = recording.end.time - recording.states.front().time;
  auto strip = figures_at(walker, recording, time / kStripFigures);
  if (strip.size() > kStripFigures) strip.resize(kStripFigures);
  folder.write("strip.svg", strip_as_svg(strip, slope));
  folder.write("strip.png", png_bytes(strip_as_image(strip, slope)));
  const double every = 1 / (job.frame_rate * job.slow_motion);
  write_animation(folder.file("animation.mp4"), figures_at(walker, recording, every), slope,
                  job.frame_rate);
}

std::string run_text(const SimulateJob& job, const Recording& recording,
                     const std::vector<std::string>& command_line) {
  const BuildFacts& facts = build_facts();
  const nlohmann::ordered_json run{{"command", "simulate"},
                                   {"version", facts.version},
                                   {"commit", facts.commit},
                                   {"model", job.model.model},
                                   {"status", name_of(recording.end.health)},
                                   {"steps", recording.steps},
                                   {"events", recording.events.size()},
                                   {"end_time", recording.end.time},
                                   {"command_line", command_line}};
  return run.dump(2) + "\n";
}

}  // namespace

const char* name_of(EventKind kind) {
  switch (kind) {
    case EventKind::kStrike:
      return "strike";
    case EventKind::kTakeOff:
      return "take_off";
    case EventKind::kStop:
      return "stop";
    case EventKind::kRelease:
      return "release";
    case EventKind::kApex:
      return "apex";
    case EventKind::kFall:
      break;
  }
  return "fall";
}

const char* name_of(Health health) {
  switch (health) {
    case Health::kSound:
      return "sound";
    case Health::kFallen:
      return "fallen";
    case Health::kDiverged:
      break;
  }
  return "diverged";
}

Recording record(const Walker& walker, const SimulateJob& job, const JobControl& control) {
  Recording recording;
  const Eigen::VectorXd x = start_point(job.model, walker);
  const Eigen::Index n = x.size() / 2;
  WalkerState& state = recording.end;
  state = walker.section_state(x.head(n), x.tail(n));
  recording.states.push_back(state);
  double next = state.time + job.sample_interval;
  WalkerState last = state;
  const auto keep = [&](const WalkerState& now) {
    recording.states.push_back(now);
    while (next <= now.time) next += job.sample_interval;
  };
  const auto observe = [&](const WalkerState& now) {
    if (now.time == last.time) {  // the states before and after an event
      if (recording.states.back().time != now.time) keep(last);
      keep(now);
    } else if (now.time >= next) {
      keep(now);
    }
    last = now;
  };
  const Walker* now = &walker;
  while (state.health == Health::kSound && state.time < job.duration && !control.stopping()) {
    if (!advance(*now, state, job.duration - state.time, job.simulation, recording.events,
                 observe)) {
      break;
    }
    ++recording.steps;
    if (job.steps > 0 && recording.steps >= job.steps) break;
    if (job.next_walker) {
      recording.changes.push_back({recording.states.size() - 1, job.next_walker(state)});
      now = recording.changes.back().walker.get();
      state = last = recording.states.back() = now->settled(state);
    }
    control.progress("simulating", static_cast<size_t>(1000 * state.time),
                     static_cast<size_t>(1000 * job.duration));
  }
  if (recording.states.back().time != state.time) keep(state);
  return recording;
}

std::string states_csv(const Walker& walker, const Recording& recording) {
  const std::vector<std::string> names = walker.coordinates();
  std::string csv = "t,phase";
  for (const std::string& name : names) csv += "," + name;
  for (const std::string& name : names) csv += "," + name + "_rate";
  csv +=
      ",kinetic,gravity,elastic,energy,ground_x,ground_z,com_x,com_z,"
      "angular_momentum\n";
  const Walker* now = &walker;
  auto change = recording.changes.begin();
  for (size_t i = 0; i < recording.states.size(); ++i) {
    if (change != recording.changes.end() && change->from == i) now = (change++)->walker.get();
    add_state(*now, recording.states[i], names.size(), csv);
  }
  return csv;
}

std::string events_csv(const Recording& recording) {
  std::string csv =
      "t,event,index,impulse_x,impulse_z,actuator_work,travel,step_length,old_foot_lifts\n";
  for (const WalkerEvent& event : recording.events) {
    const Transition& what = event.transition;
    csv += fmt::format("{:.12g},{},{}", event.time, name_of(what.kind), what.index);
    for (const double value :
         {what.impulse.x(), what.impulse.y(), what.actuator_work, what.advance, what.feet_apart}) {
      add_cell(csv, value);
    }
    csv += what.old_foot_lifts ? ",1\n" : ",0\n";
  }
  return csv;
}

std::vector<std::string> simulation_files() {
  return {"states.csv", "strip.svg", "strip.png", "animation.mp4"};
}

SimulationEnd simulate_into(const std::filesystem::path& path, bool overwrite,
                            const SimulateJob& job, const std::vector<std::string>& command_line,
                            const JobControl& control) {
  const auto walker = make_walker(job.model);
  Outputs outputs{path, "simulate", simulation_files(), {job.model_file}};
  outputs.files.insert(outputs.files.end(), {"model.yaml", "events.csv"});
  const ResultFolder folder(outputs, overwrite);
  const Recording recording = record(*walker, job, control);
  folder.write("model.yaml", model_as_yaml(job.model));
  folder.write("states.csv", states_csv(*walker, recording));
  folder.write("events.csv", events_csv(recording));
  if (job.pictures) write_pictures(folder, *walker, job, recording);
  const std::string run = run_text(job, recording, command_line);
  if (control.stopping()) {
    folder.finish_partial(run);
  } else {
    folder.finish(run);
  }
  const Health health = recording.end.health;
  return {health, fmt::format("{}: {} steps in {:.3f} s, {}", job.model.model, recording.steps,
                              recording.end.time, name_of(health))};
}

}  // namespace jobs
}  // namespace walktrack
