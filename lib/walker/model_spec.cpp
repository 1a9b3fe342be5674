#include "walker/model_spec.h"

#include <algorithm>
#include <cmath>

#include "core/conventions.h"
#include "core/errors.h"
#include "walker/linkage/linkage_walker.h"

namespace walktrack {
inline namespace walker {
namespace {

using Eigen::VectorXd;

constexpr double kHuge = 1e12;  // larger numbers are typing errors in any of these units

// Kuo's level gait with a toe-off impulse of .06.
ModelSpec default_anthropomorphic() {
  ModelSpec spec;
  spec.anthropomorphic.toe_off_impulse = 0.06;
  spec.start.q = {-.309104598, .309104598};
  spec.start.qd = {.334156693, .267997464};
  return spec;
}

ModelSpec default_monopode() {
  ModelSpec spec;
  spec.start = {{0, .9403}, {0, 0}, 1784.8};
  return spec;
}

ModelSpec default_rimless_wheel() {
  ModelSpec spec;
  spec.start = {{-spec.rimless_wheel.half_angle}, {.35}, 0};
  return spec;
}

// A stable gait of a person of 1.75 m and 70 kg, with feet that roll on .278 m.
ModelSpec default_kneed() {
  ModelSpec spec;
  spec.kneed = {
      .gravity = kStandardGravity,
      .slope = 0,
      .thigh_length = .42875,
      .shank_length = .4305,
      .foot_radius = .27825,
      .foot_forward = .05,
      .foot_up = .21,
      .torso = {.mass = 47.46, .com_above_hip = .315504, .inertia = 2.965870332},
      .thigh = {.mass = 7, .com_below_hip = .18564875, .inertia = .1342490901},
      .shank = {
          .mass = 4.27, .com_above_ankle = .169617, .com_forward = 0, .inertia = .1369496251}};
  spec.controls = {.torso = {173.5474035, 55.0660946, -.003523997719},
                   .hip = {34.01769782, .1828420056, .1071902856},
                   .stance_knee = {209.7990865, 25.31230768, .2137262606},
                   .swing_knee = {5.874864838, 1.790586193, .01318178102},
                   .toe_off_impulse = 54.21844355};
  spec.style.may_fly = false;
  spec.start.q = {-.0756666117217, -.423117277931, .504895874607, -.423117277931, .742987533045};
  spec.start.qd = {-1.21737399016, -.041695245998, 1.18026603848, 4.78334527693, 1.80017718404};
  return spec;
}

class Table {
 public:
  void number(const char* key, double& value, double lowest, double highest, const char* comment) {
    entries_.push_back({key, comment, &value, nullptr, nullptr, lowest, highest});
  }
  void flag(const char* key, bool& value, const char* comment) {
    entries_.push_back({key, comment, nullptr, &value, nullptr, 0, 0});
  }
  void list(const char* key, std::vector<double>& value, const char* comment) {
    entries_.push_back({key, comment, nullptr, nullptr, &value, -kHuge, kHuge});
  }
  std::vector<ModelEntry> take() { return std::move(entries_); }

 private:
  std::vector<ModelEntry> entries_;
};

void add_world(Table& table, double& gravity, double& slope) {
  table.number("parameters.gravity", gravity, 0, 1e6, "m/s^2");
  table.number("parameters.slope", slope, -kPi / 2, kPi / 2, "rad, > 0 downhill");
}

void add_monopode(Table& table, MonopodeParameters& p, double& energy) {
  table.number("parameters.gravity", p.gravity, 0, 1e6, "m/s^2");
  table.number("parameters.mass", p.mass, 1e-12, kHuge, "kg");
  table.number("parameters.leg_length", p.leg_length, 1e-6, 1e6, "m, at rest");
  table.number("parameters.stiffness", p.stiffness, 0, kHuge, "N/m");
  table.number("parameters.attack", p.attack, 0, kPi / 2, "rad, landing leg over the ground");
  table.flag("parameters.walks", p.walks, "two legs with double support; else it runs");
  table.number("start.energy", energy, 0, kHuge, "J; 0: the speed is that of start.qd");
}

void add_rimless_wheel(Table& table, RimlessWheelParameters& p) {
  add_world(table, p.gravity, p.slope);
  table.number("parameters.mass", p.mass, 1e-12, kHuge, "kg");
  table.number("parameters.spoke", p.spoke, 1e-6, 1e6, "m");
  table.number("parameters.half_angle", p.half_angle, 1e-3, kPi / 2, "rad, half between spokes");
  table.number("parameters.gyration", p.gyration, 0, 1e6, "m, radius of gyration about the hub");
}

void add_anthropomorphic(Table& table, StraightLeggedParameters& p) {
  add_world(table, p.gravity, p.slope);
  table.number("parameters.hip_mass", p.hip_mass, 0, kHuge, "kg");
  table.number("parameters.leg_mass", p.leg_mass, 1e-15, kHuge, "kg, each");
  table.number("parameters.leg_inertia", p.leg_inertia, 0, kHuge,
               "kg m^2 about its centre of mass");
  table.number("parameters.hip_to_arc", p.hip_to_arc, 1e-6, 1e6, "m, hip to foot's arc centre");
  table.number("parameters.com_below_hip", p.com_below_hip, -1e6, 1e6, "m, leg's centre of mass");
  table.number("parameters.foot_radius", p.foot_radius, 0, 1e6, "m");
  table.number("controls.hip_stiffness", p.hip_stiffness, 0, kHuge, "N m/rad between the legs");
  table.number("controls.toe_off_impulse", p.toe_off_impulse, 0, kHuge, "N s");
  table.number("style.widest_spread", p.widest_spread, 0, kPi,
               "rad, legs open no further; 0: free");
  table.flag("style.may_fly", p.may_fly, "the stance foot is released when the ground would pull");
}

void add_kneed(Table& table, KneedParameters& p) {
  add_world(table, p.gravity, p.slope);
  table.number("parameters.thigh_length", p.thigh_length, 1e-6, 1e6, "m");
  table.number("parameters.shank_length", p.shank_length, 1e-6, 1e6, "m, knee to ankle");
  table.number("parameters.foot_radius", p.foot_radius, 0, 1e6, "m");
  table.number("parameters.foot_forward", p.foot_forward, -1e6, 1e6,
               "m, arc centre ahead of shank");
  table.number("parameters.foot_up", p.foot_up, -1e6, 1e6, "m, arc centre above the ankle");
  table.number("parameters.torso.mass", p.torso.mass, 0, kHuge, "kg");
  table.number("parameters.torso.com_above_hip", p.torso.com_above_hip, -1e6, 1e6, "m");
  table.number("parameters.torso.inertia", p.torso.inertia, 0, kHuge, "kg m^2");
  table.number("parameters.thigh.mass", p.thigh.mass, 1e-15, kHuge, "kg");
  table.number("parameters.thigh.com_below_hip", p.thigh.com_below_hip, -1e6, 1e6, "m");
  table.number("parameters.thigh.inertia", p.thigh.inertia, 0, kHuge, "kg m^2");
  table.number("parameters.shank.mass", p.shank.mass, 1e-15, kHuge, "kg, with the foot");
  table.number("parameters.shank.com_above_ankle", p.shank.com_above_ankle, -1e6, 1e6, "m");
  table.number("parameters.shank.com_forward", p.shank.com_forward, -1e6, 1e6, "m");
  table.number("parameters.shank.inertia", p.shank.inertia, 0, kHuge, "kg m^2");
}

void add_kneed_controls(Table& table, KneedControls& c, KneedStyle& style) {
  table.number("controls.torso.stiffness", c.torso.stiffness, 0, kHuge, "N m/rad, to the vertical");
  table.number("controls.torso.damping", c.torso.damping, 0, kHuge, "N m s/rad");
  table.number("controls.torso.rest", c.torso.rest, -10, 10, "rad");
  table.number("controls.hip.stiffness", c.hip.stiffness, 0, kHuge, "N m/rad");
  table.number("controls.hip.damping", c.hip.damping, 0, kHuge, "N m s/rad");
  table.number("controls.hip.rest", c.hip.rest, -10, 10, "rad, stance thigh - swing thigh");
  table.number("controls.stance_knee.stiffness", c.stance_knee.stiffness, 0, kHuge, "N m/rad");
  table.number("controls.stance_knee.damping", c.stance_knee.damping, 0, kHuge, "N m s/rad");
  table.number("controls.stance_knee.rest", c.stance_knee.rest, -10, 10, "rad, flexion");
  table.number("controls.swing_knee.stiffness", c.swing_knee.stiffness, 0, kHuge, "N m/rad");
  table.number("controls.swing_knee.damping", c.swing_knee.damping, 0, kHuge, "N m s/rad");
  table.number("controls.swing_knee.rest", c.swing_knee.rest, -10, 10, "rad, flexion");
  table.number("controls.toe_off_impulse", c.toe_off_impulse, 0, kHuge, "N s");
  table.flag("style.latched", style.latched, "passive knees: latched in stance and at their stop");
  table.flag("style.may_fly", style.may_fly,
             "runs: the foot is released when the ground would pull");
}

}  // namespace

const std::vector<std::string>& model_names() {
  static const std::vector<std::string> names{"monopode", "rimless_wheel", "anthropomorphic",
                                              "kneed"};
  return names;
}

ModelSpec default_model(const std::string& name) {
  ModelSpec spec;
  if (name == "monopode") {
    spec = default_monopode();
  } else if (name == "rimless_wheel") {
    spec = default_rimless_wheel();
  } else if (name == "anthropomorphic") {
    spec = default_anthropomorphic();
  } else if (name == "kneed") {
    spec = default_kneed();
  } else {
    std::string allowed;
    for (const std::string& known : model_names()) allowed += (allowed.empty() ? "" : ", ") + known;
    throw UsageError(describe({"", 0, "model"}, "'" + name + "'", allowed));
  }
  spec.model = name;
  return spec;
}

std::vector<ModelEntry> entries(ModelSpec& spec) {
  Table table;
  if (spec.model == "monopode") add_monopode(table, spec.monopode, spec.start.energy);
  if (spec.model == "rimless_wheel") add_rimless_wheel(table, spec.rimless_wheel);
  if (spec.model == "anthropomorphic") add_anthropomorphic(table, spec.anthropomorphic);
  if (spec.model == "kneed") {
    add_kneed(table, spec.kneed);
    add_kneed_controls(table, spec.controls, spec.style);
  }
  table.list("start.q", spec.start.q, "rad (monopode: m), the model's coordinates");
  table.list("start.qd", spec.start.qd, "rad/s (monopode: m/s)");
  return table.take();
}

std::unique_ptr<Walker> make_walker(const ModelSpec& spec) {
  if (spec.model == "monopode") return std::make_unique<Monopode>(spec.monopode);
  if (spec.model == "rimless_wheel") {
    return std::make_unique<LinkageWalker>(rimless_wheel(spec.rimless_wheel));
  }
  if (spec.model == "anthropomorphic") {
    return std::make_unique<LinkageWalker>(straight_legged(spec.anthropomorphic));
  }
  return std::make_unique<LinkageWalker>(kneed(spec.kneed, spec.controls, spec.style));
}

VectorXd start_point(const ModelSpec& spec, const Walker& walker) {
  const size_t n = walker.section_size();
  const auto check = [n](const char* key, const std::vector<double>& values) {
    if (values.size() == n) return;
    throw UsageError(describe({"", 0, key}, std::to_string(values.size()) + " numbers",
                              std::to_string(n) + ", one for each coordinate"));
  };
  check("start.q", spec.start.q);
  check("start.qd", spec.start.qd);
  VectorXd x(2 * static_cast<Eigen::Index>(n));
  std::copy(spec.start.q.begin(), spec.start.q.end(), x.begin());
  std::copy(spec.start.qd.begin(), spec.start.qd.end(), x.begin() + static_cast<Eigen::Index>(n));
  const auto apex = at_energy(spec, x);
  if (!apex) {
    throw UsageError(describe({"", 0, "start.energy"}, std::to_string(spec.start.energy) + " J",
                              "more than the energy of standing at start.q"));
  }
  return *apex;
}

std::optional<VectorXd> at_energy(const ModelSpec& spec, const VectorXd& x) {
  if (spec.model != "monopode" || spec.start.energy == 0) return x;
  auto apex = Monopode(spec.monopode).apex(x(1), x(0), spec.start.energy);
  if (apex) (*apex)(2) = std::copysign((*apex)(2), x(2));
  return apex;
}

}  // namespace walker
}  // namespace walktrack
