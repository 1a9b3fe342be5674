#include "tests/walker/kneed_files.h"

#include <yaml-cpp/yaml.h>

#include <string>

namespace walktrack {
namespace {

YAML::Node load(const char* name) {
  return YAML::LoadFile(std::string(WALKTRACK_SOURCE_DIR "/tests/walker/") + name);
}

Vector5 vector_of(const YAML::Node& node) {
  Vector5 v;
  for (int i = 0; i < 5; ++i) v[i] = node[i].as<double>();
  return v;
}

SpringDamper spring_of(const YAML::Node& node) {
  return {node["stiffness"].as<double>(), node["damping"].as<double>(), node["rest"].as<double>()};
}

KneedControls controls_of(const YAML::Node& node) {
  KneedControls c{.torso = spring_of(node["torso"]),
                  .hip = spring_of(node["hip"]),
                  .stance_knee = spring_of(node["stance_knee"]),
                  .swing_knee = spring_of(node["swing_knee"])};
  if (node["toe_off_impulse"]) c.toe_off_impulse = node["toe_off_impulse"].as<double>();
  return c;
}

KneedParameters parameters_of(const YAML::Node& node) {
  const auto number = [](const YAML::Node& n, const char* key) { return n[key].as<double>(); };
  const YAML::Node torso = node["torso"], thigh = node["thigh"], shank = node["shank"];
  KneedParameters p;
  p.gravity = number(node, "gravity");
  p.slope = number(node, "slope");
  p.thigh_length = number(node, "thigh_length");
  p.shank_length = number(node, "shank_length");
  p.foot_radius = number(node, "foot_radius");
  p.foot_forward = number(node, "foot_forward");
  p.foot_up = number(node, "foot_up");
  p.torso = {number(torso, "mass"), number(torso, "com_above_hip"), number(torso, "inertia")};
  p.thigh = {number(thigh, "mass"), number(thigh, "com_below_hip"), number(thigh, "inertia")};
  p.shank = {number(shank, "mass"), number(shank, "com_above_ankle"), number(shank, "com_forward"),
             number(shank, "inertia")};
  return p;
}

KneedState state_of(const YAML::Node& node) {
  KneedState state;
  state.q = vector_of(node["q"]);
  state.qd = vector_of(node["qd"]);
  return state;
}

ReferenceState reference_state(const YAML::Node& node) {
  ReferenceState r;
  r.state = state_of(node);
  for (int i = 0; i < 5; ++i) r.mass_matrix.row(i) = vector_of(node["mass_matrix"][i]);
  r.qdd_free = vector_of(node["qdd_free"]);
  r.energy = node["energy"].as<double>();
  r.strike_impulse_0 = state_of(node["strike_impulse_0"]);
  r.strike_impulse_20 = state_of(node["strike_impulse_20"]);
  if (node["knees_at_limit"]) {
    r.state.stance_stop = node["knees_at_limit"][0].as<bool>();
    r.state.swing_stop = node["knees_at_limit"][1].as<bool>();
    r.qdd_limited = vector_of(node["qdd_limited"]);
    r.limit_torque = {node["limit_torque"][0].as<double>(), node["limit_torque"][1].as<double>()};
  }
  return r;
}

}  // namespace

ReferenceFile read_kneed_reference() {
  const YAML::Node root = load("kneed_reference.yaml");
  ReferenceFile file{parameters_of(root["parameters"]), controls_of(root["controls"]), {}};
  for (const YAML::Node& node : root["states"]) file.states.push_back(reference_state(node));
  return file;
}

CycleFile read_kneed_cycles() {
  const YAML::Node root = load("kneed_cycles.yaml");
  CycleFile file{parameters_of(root["parameters"]), {}};
  for (const YAML::Node& node : root["cycles"]) {
    file.cycles.push_back({.speed = node["speed"].as<double>(),
                           .step_length = node["step_length"].as<double>(),
                           .period = node["period"].as<double>(),
                           .controls = controls_of(node["controls"]),
                           .start = state_of(node),
                           .clearance = node["clearance"].as<double>()});
  }
  return file;
}

}  // namespace walktrack
