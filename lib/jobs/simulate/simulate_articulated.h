// `walktrack simulate --model articulated`: a person of five segments in 3-D (trunk, thighs on ball
// joints, shanks on hinges) who tumbles, falls or hangs by a foot or the head, without muscles.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "core/conventions.h"
#include "jobs/simulate/simulate_job.h"
#include "mechanics/articulated_dynamics.h"
#include "walker/model_spec.h"

namespace walktrack {
inline namespace jobs {

struct ArticulatedSpec {
  double height = 1.75;               // m
  double mass = 70;                   // kg
  double gravity = kStandardGravity;  // m/s^2
  double joint_damping = 0;           // N m s/rad, on every joint rate
  bool hold_left_foot = false;        // at its start position
  bool hold_right_foot = false;
  bool hold_head = false;
  bool project = true;                    // holds are projected after each step
  double baumgarte_rate = 0;              // 1/s, if they are not projected
  std::vector<double> position{0, 0, 1};  // m, of the hip centre
  std::vector<double> velocity{0, 0, 0};  // m/s
  std::vector<double> spin{0, 0, 0};      // rad/s, of the trunk, its axes
  std::vector<double> left_hip{0, 0, 0};  // rad, rotation vectors of the thighs
  std::vector<double> right_hip{0, 0, 0};
  double left_knee = 0, right_knee = 0;  // rad, flexion
};

std::vector<ModelEntry> entries(ArticulatedSpec& spec);

// Masses and lengths according to Winter's table; the solids are elliptic cones with these values.
ArticulatedBody articulated_person(const ArticulatedSpec& spec);

struct ArticulatedJob {
  ArticulatedSpec spec;
  std::filesystem::path model_file{};  // the file from which it was read, if any
  double duration = 2;                 // s
  double step = 1e-3;                  // s
  double sample_interval = 0.01;       // s
  double frame_rate = 30;              // Hz
  double slow_motion = 1;              // times slower than life
  Integrator integrator = Integrator::kRk4;
  bool pictures = true;
};

struct ArticulatedSample {
  double time = 0;
  ArticulatedState state;
};

struct ArticulatedRecording {
  std::vector<ArticulatedSample> samples;
  bool diverged = false;
};
ArticulatedRecording record(const ArticulatedBody& body, const ArticulatedJob& job);

// t, q, u, kinetic and gravity energy (J), centre of mass (m), angular momentum about it (kg
// m^2/s), total force of the holds (N) and their drift (m).
std::string states_csv(const ArticulatedBody& body, const ArticulatedJob& job,
                       const ArticulatedRecording& recording);

// Runs the job into a folder in the same way as simulate_into(). UsageError for a list without
// three numbers.
SimulationEnd simulate_articulated_into(const std::filesystem::path& folder, bool overwrite,
                                        const ArticulatedJob& job,
                                        const std::vector<std::string>& command_line);

}  // namespace jobs
}  // namespace walktrack
