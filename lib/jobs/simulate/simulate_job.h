// `walktrack simulate`: simulates a walker and writes tables, images and an animation.
#pragma once

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "core/job_control.h"
#include "walker/model_spec.h"
#include "walker/simulate.h"

namespace walktrack {
inline namespace jobs {

// The walker of the next step after a step that ended in this state; it may have other controls.
using NextWalker = std::function<std::unique_ptr<Walker>(const WalkerState&)>;

struct SimulateJob {
  ModelSpec model;
  std::filesystem::path model_file{};  // the file from which it was read, if any
  SimulationOptions simulation;
  double duration = 5;            // s
  int steps = 0;                  // > 0: stop after so many steps
  double sample_interval = 0.01;  // s, between rows of states.csv
  double frame_rate = 30;         // Hz, of the animation
  double slow_motion = 1;         // times slower than life
  bool pictures = true;           // strip.svg, strip.png, animation.mp4
  NextWalker next_walker;         // empty: the same walker for all steps
};

// The recorded states: one for every sample, and those before and after every event.
struct Recording {
  std::vector<WalkerState> states;
  std::vector<WalkerEvent> events;
  WalkerState end;
  int steps = 0;
  struct Change {
    size_t from;  // index of its first state
    std::unique_ptr<Walker> walker;
  };
  std::vector<Change> changes;  // of the walker, if the job has next_walker
};
Recording record(const Walker& walker, const SimulateJob& job, const JobControl& control);

// t, phase, coordinates and rates, kinetic, gravity, elastic and total energy (J), ground force
// (N), centre of mass (m), whole-body angular momentum about it (kg m^2/s, positive forward). Cells
// are empty for coordinates that do not exist in a phase.
std::string states_csv(const Walker& walker, const Recording& recording);

// t, event, index, impulse of the ground (N s), work of the toe-off (J), travel and step length
// (m).
std::string events_csv(const Recording& recording);

// All files that a simulation may write.
std::vector<std::string> simulation_files();

// Runs the job; the folder contains states.csv, events.csv, model.yaml, the images and run.json.
// `command_line` is recorded in run.json.
struct SimulationEnd {
  Health health = Health::kSound;
  std::string text;  // one line of text
};
SimulationEnd simulate_into(const std::filesystem::path& folder, bool overwrite,
                            const SimulateJob& job, const std::vector<std::string>& command_line,
                            const JobControl& control);

const char* name_of(EventKind kind);
const char* name_of(Health health);

}  // namespace jobs
}  // namespace walktrack
