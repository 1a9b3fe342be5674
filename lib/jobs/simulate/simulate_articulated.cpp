#include "jobs/simulate/simulate_articulated.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/anthropometry.h"
#include "core/errors.h"
#include "core/version.h"
#include "io/archive/result_folder.h"
#include "io/drawing/picture.h"
#include "io/drawing/stick_figure.h"
#include "jobs/simulate/simulate_job.h"

namespace walktrack {
inline namespace jobs {
namespace {

using Eigen::Vector2d;
using Eigen::Vector3d;
using Eigen::VectorXd;

enum PartIndex { kTrunk, kLeftThigh, kRightThigh, kLeftShank, kRightShank };

// Shares of height (core/anthropometry.h); the shank reaches to the sole.
constexpr double kTrunkLength = anthropometry::kTrunk, kThighLength = anthropometry::kThigh;
constexpr double kShankLength = .285;
constexpr double kHeadAboveHips = .47;  // above the hips
constexpr double kTrunkMass = anthropometry::kHeadArmsTrunk.mass;
constexpr double kThighMass = anthropometry::kThighShares.mass;
constexpr double kShankMass = anthropometry::kShankAndFoot.mass;
constexpr double kHipHalfWidth = .0955;

// Rates (rad/s, m/s) above which the integration has diverged.
constexpr double kLargestRate = 1e6;

Vector3d vector3(const char* key, const std::vector<double>& values) {
  if (values.size() != 3) {
    throw UsageError(
        describe({"", 0, key}, fmt::format("{} numbers", values.size()), "three numbers"));
  }
  return {values[0], values[1], values[2]};
}

// A cone of the given mass from the origin along z (up or down).
MassProperties cone(double mass, double length, const Vector2d& base, const Vector2d& top,
                    bool hangs) {
  MassProperties solid = elliptic_frustum(1, length, base, top);
  const double density = mass / solid.mass;
  solid.mass = mass;
  solid.inertia *= density;
  if (!hangs) return solid;
  const Eigen::Matrix3d turned = Vector3d(1, -1, -1).asDiagonal();
  return transformed(solid, turned, Vector3d::Zero());
}

ArticulatedPart limb(const MassProperties& mass, int parent, JointKind joint,
                     const Vector3d& anchor) {
  ArticulatedPart part;
  part.mass = mass;
  part.parent = parent;
  part.joint = joint;
  part.anchor = anchor;
  return part;
}

ArticulatedState start_of(const ArticulatedBody& body, const ArticulatedSpec& spec) {
  ArticulatedState state{body.zero_positions(), VectorXd::Zero(body.velocities())};
  state.q.head<3>() = vector3("start.position", spec.position);
  state.u.head<3>() = vector3("start.velocity", spec.velocity);
  state.u.segment<3>(3) = vector3("start.spin", spec.spin);
  state.q.segment<4>(body.position_index(kLeftThigh)) =
      quaternion_from_vector(vector3("start.left_hip", spec.left_hip));
  state.q.segment<4>(body.position_index(kRightThigh)) =
      quaternion_from_vector(vector3("start.right_hip", spec.right_hip));
  state.q(body.position_index(kLeftShank)) = spec.left_knee;
  state.q(body.position_index(kRightShank)) = spec.right_knee;
  return state;
}

std::vector<PartMotion> motions_of(const ArticulatedBody& body, const ArticulatedState& state) {
  return part_motions(body, state.q, state.u, VectorXd::Zero(body.velocities()));
}

std::vector<Attachment> holds(const ArticulatedBody& body, const ArticulatedSpec& spec) {
  const auto motions = motions_of(body, start_of(body, spec));
  const Vector3d foot(0, 0, -kShankLength * spec.height), head(0, 0, kHeadAboveHips * spec.height);
  std::vector<Attachment> held;
  const auto hold = [&](bool wanted, size_t part, const Vector3d& point) {
    if (wanted) held.push_back({part, point, point_position(motions[part], point)});
  };
  hold(spec.hold_left_foot, kLeftShank, foot);
  hold(spec.hold_right_foot, kRightShank, foot);
  hold(spec.hold_head, kTrunk, head);
  return held;
}

BodyLoad load_of(const ArticulatedBody& body, const ArticulatedSpec& spec, const VectorXd& u) {
  BodyLoad load;
  load.gravity = Vector3d(0, 0, -spec.gravity);
  load.joint_forces = VectorXd::Zero(body.velocities());
  load.joint_forces.tail(body.velocities() - 6) = -spec.joint_damping * u.tail(u.size() - 6);
  return load;
}

StickFigure figure_of(const ArticulatedBody& body, const ArticulatedSpec& spec,
                      const ArticulatedSample& sample) {
  const auto motions = motions_of(body, sample.state);
  StickFigure figure{sample.time, body_momentum(body, sample.state.q, sample.state.u).com.x(), {}};
  const auto line = [&](size_t part, const Vector3d& tip, int group) {
    const Vector3d from = motions[part].origin, to = point_position(motions[part], tip);
    figure.lines.push_back({{from.x(), from.z()}, {to.x(), to.z()}, group});
  };
  const double H = spec.height;
  line(kTrunk, {0, 0, kHeadAboveHips * H}, 0);
  line(kLeftThigh, {0, 0, -kThighLength * H}, 1);
  line(kLeftShank, {0, 0, -kShankLength * H}, 1);
  line(kRightThigh, {0, 0, -kThighLength * H}, 2);
  line(kRightShank, {0, 0, -kShankLength * H}, 2);
  return figure;
}

std::vector<StickFigure> figures(const ArticulatedBody& body, const ArticulatedSpec& spec,
                                 const ArticulatedRecording& recording, double every) {
  std::vector<StickFigure> result;
  double next = 0;
  for (const ArticulatedSample& sample : recording.samples) {
    if (sample.time < next - 1e-9) continue;
    const StickFigure figure = figure_of(body, spec, sample);
    for (; next - 1e-9 <= sample.time; next += every) result.push_back(figure);
  }
  return result;
}

}  // namespace

std::vector<ModelEntry> entries(ArticulatedSpec& spec) {
  std::vector<ModelEntry> all;
  const auto number = [&](const char* key, double& value, double lowest, double highest,
                          const char* comment) {
    all.push_back({key, comment, &value, nullptr, nullptr, lowest, highest});
  };
  const auto flag = [&](const char* key, bool& value, const char* comment) {
    all.push_back({key, comment, nullptr, &value, nullptr, 0, 0});
  };
  const auto list = [&](const char* key, std::vector<double>& value, const char* comment) {
    all.push_back({key, comment, nullptr, nullptr, &value, -1e6, 1e6, 3});
  };
  number("parameters.height", spec.height, .1, 10, "m");
  number("parameters.mass", spec.mass, 1e-3, 1e6, "kg");
  number("parameters.gravity", spec.gravity, 0, 1e6, "m/s^2");
  number("parameters.joint_damping", spec.joint_damping, 0, 1e6, "N m s/rad");
  flag("style.hold_left_foot", spec.hold_left_foot, "the sole stays where it is");
  flag("style.hold_right_foot", spec.hold_right_foot, "the sole stays where it is");
  flag("style.hold_head", spec.hold_head, "the head stays where it is");
  flag("style.project", spec.project, "holds are projected after each step");
  number("style.baumgarte_rate", spec.baumgarte_rate, 0, 1e6, "1/s, when not projected");
  list("start.position", spec.position, "m, of the hips' centre");
  list("start.velocity", spec.velocity, "m/s");
  list("start.spin", spec.spin, "rad/s, of the trunk about its axes");
  list("start.left_hip", spec.left_hip, "rad, rotation vector of the thigh");
  list("start.right_hip", spec.right_hip, "rad, rotation vector of the thigh");
  number("start.left_knee", spec.left_knee, -4, 4, "rad, flexion");
  number("start.right_knee", spec.right_knee, -4, 4, "rad, flexion");
  return all;
}

ArticulatedBody articulated_person(const ArticulatedSpec& spec) {
  const double H = spec.height, M = spec.mass;
  const MassProperties trunk =
      cone(kTrunkMass * M, 1.5 * kTrunkLength * H, {.06 * H, .09 * H}, {.05 * H, .08 * H}, false);
  const MassProperties thigh =
      cone(kThighMass * M, kThighLength * H, {.05 * H, .05 * H}, {.03 * H, .03 * H}, true);
  const MassProperties shank =
      cone(kShankMass * M, kShankLength * H, {.032 * H, .032 * H}, {.02 * H, .02 * H}, true);
  const Vector3d hip(0, kHipHalfWidth * H, 0), knee(0, 0, -kThighLength * H);
  ArticulatedPart root;
  root.mass = trunk;
  return ArticulatedBody({root, limb(thigh, kTrunk, JointKind::kBall, hip),
                          limb(thigh, kTrunk, JointKind::kBall, -hip),
                          limb(shank, kLeftThigh, JointKind::kHinge, knee),
                          limb(shank, kRightThigh, JointKind::kHinge, knee)});
}

ArticulatedRecording record(const ArticulatedBody& body, const ArticulatedJob& job) {
  ArticulatedRecording recording;
  const auto held = holds(body, job.spec);
  ArticulatedStepOptions options{.integrator = job.integrator};
  if (!job.spec.project) {
    options.stabilisation = Stabilisation::kBaumgarte;
    options.baumgarte_rate = job.spec.baumgarte_rate;
  }
  ArticulatedSample now{0, start_of(body, job.spec)};
  if (!held.empty()) {  // projects the start velocities on what the holds allow
    auto& [q, u] = now.state;
    u = projected_velocity(assemble(body, q, u, {}).mass, attachment_constraint(body, q, u, held),
                           u);
  }
  recording.samples.push_back(now);
  const auto steps = std::llround(job.duration / job.step);
  const auto every = std::max(1LL, std::llround(job.sample_interval / job.step));
  for (long long i = 1; i <= steps; ++i) {
    const auto next =
        step(body, now.state, load_of(body, job.spec, now.state.u), held, job.step, options);
    if (!next || next->u.cwiseAbs().maxCoeff() > kLargestRate) {
      recording.diverged = true;
      break;
    }
    now = {static_cast<double>(i) * job.step, *next};
    if (i % every == 0) recording.samples.push_back(now);
  }
  return recording;
}

std::string states_csv(const ArticulatedBody& body, const ArticulatedJob& job,
                       const ArticulatedRecording& recording) {
  std::string csv = "t";
  for (Eigen::Index i = 0; i < body.positions(); ++i) csv += fmt::format(",q{}", i);
  for (Eigen::Index i = 0; i < body.velocities(); ++i) csv += fmt::format(",u{}", i);
  csv +=
      ",kinetic,gravity,com_x,com_y,com_z,spin_x,spin_y,spin_z,hold_x,hold_y,hold_z,hold_drift\n";
  const auto held = holds(body, job.spec);
  for (const ArticulatedSample& sample : recording.samples) {
    const auto& [q, u] = sample.state;
    const BodyMomentum momentum = body_momentum(body, q, u);
    const ForwardDynamics forces =
        forward_dynamics(body, q, u, load_of(body, job.spec, u), held, 0);
    Vector3d hold = Vector3d::Zero();
    for (const Vector3d& force : forces.attachment_forces) hold += force;
    const double drift =
        held.empty() ? 0.0 : attachment_constraint(body, q, u, held).value.cwiseAbs().maxCoeff();
    csv += fmt::format("{:.12g}", sample.time);
    const auto cells = [&](const VectorXd& values) {
      for (const double value : values) csv += fmt::format(",{:.12g}", value);
    };
    cells(q);
    cells(u);
    cells(Vector2d(momentum.kinetic_energy, body.mass() * job.spec.gravity * momentum.com.z()));
    cells(momentum.com);
    cells(momentum.angular);
    cells(hold);
    csv += fmt::format(",{:.3g}\n", drift);
  }
  return csv;
}

SimulationEnd simulate_articulated_into(const std::filesystem::path& path, bool overwrite,
                                        const ArticulatedJob& job,
                                        const std::vector<std::string>& command_line) {
  const ArticulatedBody body = articulated_person(job.spec);
  const ArticulatedRecording recording = record(body, job);
  const ResultFolder folder({path, "simulate", simulation_files(), {job.model_file}}, overwrite);
  folder.write("states.csv", states_csv(body, job, recording));
  if (job.pictures) {
    constexpr int kStripFigures = 12;
    const double time = recording.samples.back().time;
    const auto strip = figures(body, job.spec, recording, time / (kStripFigures - 1));
    folder.write("strip.svg", strip_as_svg(strip, 0));
    folder.write("strip.png", png_bytes(strip_as_image(strip, 0)));
    write_animation(folder.file("animation.mp4"),
                    figures(body, job.spec, recording, 1 / (job.frame_rate * job.slow_motion)), 0,
                    job.frame_rate);
  }
  const Health health = recording.diverged ? Health::kDiverged : Health::kSound;
  const BuildFacts& facts = build_facts();
  const nlohmann::ordered_json run{
      {"command", "simulate"},       {"version", facts.version},
      {"commit", facts.commit},      {"model", "articulated"},
      {"status", name_of(health)},   {"end_time", recording.samples.back().time},
      {"command_line", command_line}};
  folder.finish(run.dump(2) + "\n");
  return {health,
          fmt::format("articulated: {:.3f} s, {}", recording.samples.back().time, name_of(health))};
}

}  // namespace jobs
}  // namespace walktrack
