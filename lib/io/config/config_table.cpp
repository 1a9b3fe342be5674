#include "io/config/config_table.h"

#include <limits>
#include <utility>

#include "io/video/video.h"
#include "observation/terms.h"

namespace walktrack {

namespace {

constexpr double kAnyPositive = 1e9;
constexpr int kMostThreads = 4096;

void add_run(ParameterTable& table) {
  ParameterGroup<Config> top(table, "", "the run");
  top.integer("seed", &Config::seed, 0, std::numeric_limits<int64_t>::max(),
              "seed of all random numbers");
  top.integer("threads", &Config::threads, 0, kMostThreads,
              "threads, 0 = all that the process may use");
}

// Where likelihood terms write down the keys of their configuration.
struct TermGroups {
  ParameterTable& table;

  template <typename Group>
  ParameterGroup<Group> group(const std::string& name, std::string about,
                              Group ObservationConfig::*member) const {
    return {table, "observation." + name, std::move(about), &Config::observation, member};
  }
};

void add_observation(ParameterTable& table) {
  using O = ObservationConfig;
  ParameterGroup<O> o(table, "observation", "how images become likelihoods", &Config::observation);
  o.number("person_px", &O::person_px, 1, kAnyPositive,
           "images are shrunk while a standing subject stays this high, px");
  o.number("clip", &O::clip, 0, kAnyPositive, "what one pixel may say at most, nats");
  o.number("independent_m", &O::independent_m, 1e-3, 1,
           "side of a patch on the body that counts as one independent pixel, m");

  TermGroups groups{table};
  Terms::each([&]<typename Term>() { Term::describe(groups); });
}

void add_body(ParameterTable& table) {
  ParameterGroup<BodyGroups> b(table, "body", "which parts of the body are modelled",
                               &Config::body);
  b.flag("head", &BodyGroups::head, "whether head and neck are");
  b.flag("arms", &BodyGroups::arms, "whether the arms are");
}

void add_motion(ParameterTable& table) {
  using M = MotionConfig;
  ParameterGroup<M> m(table, "motion", "how the walker moves", &Config::tracker,
                      &TrackerConfig::motion);
  m.choice("model", &M::model,
           {{"kneed", MotionKind::kKneed},
            {"anthropomorphic", MotionKind::kAnthropomorphic},
            {"markov", MotionKind::kMarkov}},
           "what moves particles: the kneed walker, one of straight legs, or none");
  m.choice("path", &M::path, {{"spatial", Path::kSpatial}, {"sagittal", Path::kSagittal}},
           "where it goes: anywhere, or along a line in whose upright plane all moves");
  m.number("unrest", &M::unrest, 0, 100, "multiplies the noise of model markov");
  m.number("torso_torque", &M::torso_torque, 0, 10, "torque noise, M g L per sqrt(s)");
  m.number("hip_torque", &M::hip_torque, 0, 10, "torque noise, M g L per sqrt(s)");
  m.number("stance_knee_torque", &M::stance_knee_torque, 0, 10, "torque noise, M g L per sqrt(s)");
  m.number("swing_knee_torque", &M::swing_knee_torque, 0, 10, "torque noise, M g L per sqrt(s)");
  m.number("ankle_torque", &M::ankle_torque, 0, 10, "torque noise, M g L per sqrt(s)");
  m.number("torque_noise_scale", &M::torque_noise_scale, 0, 1000, "multiplies all five torques");
  m.number("clock", &M::clock, 0, 1, "how far the phase strays from the walker's, s per sqrt(s)");
  m.number("turning", &M::turning, 0, 100, "the usual rate of turning, rad/s");
  m.number("facing", &M::facing, 0.01, 1000,
           "time in which a heading comes back to the way that is gone, s");
  m.number("misfit", &M::misfit, 0, 10, "multiplies how far angles stray from the walker's");
  m.number("ball_drift", &M::ball_drift, 0, 1, "of a standing foot along its way, m per sqrt(s)");
  m.number("ball_slip", &M::ball_slip, 0, 1, "and across it, m per sqrt(s)");
  m.number("landing", &M::landing, 0, 1, "uncertainty of where a foot comes down, m");
  m.number("settling", &M::settling, 1e-3, 10, "in which that dies away, s");
  m.number("arrival", &M::arrival, 0, 10, "uncertainty of the first foot's place, m");
  m.number("given", &M::given, 0, 10, "the same where the scene says it with `initial`, m");
  m.number("control_noise", &M::control_noise, 0, 1, "relative, per step");
  m.number("feedback", &M::feedback, 0, 1, "correction of controls at a support transfer");
  m.number("aim_drift", &M::aim_drift, 0, 1, "relative, per step, of speed and step length");
  m.number("rephasing", &M::rephasing, 0, 100,
           "1/s: how often a particle reads its pose as another moment of a step");
  m.flag("standing", &M::standing, "whether people may stand, set off and stop");
}

void add_filter(ParameterTable& table) {
  using F = FilterConfig;
  ParameterGroup<F> f(table, "filter", "the particle filter", &Config::tracker,
                      &TrackerConfig::filter);
  f.integer("particles", &F::particles, 1, 10'000'000, "particles");
  f.number("resample_below", &F::resample_below, 0, 1, "share of effective particles");
  f.number("layer_ess", &F::layer_ess, 0, 1, "effective share that a layer may cost down to");
  f.integer("max_layers", &F::max_layers, 1, 1000, "tempered layers of a frame; 1 = none");
  f.integer("moves", &F::moves, 0, 1000, "moves of a particle after each layer");
}

void add_search(ParameterTable& table) {
  using S = DetectorConfig;
  ParameterGroup<S> s(table, "search", "finding the walker", &Config::tracker,
                      &TrackerConfig::detector);
  s.number("window", &S::window, 0.1, 10, "video that a walk is read from, s");
  s.number("slowest", &S::slowest, 0, 10, "who is slower is not walking, m/s");
  s.number("fastest", &S::fastest, 0.1, 20, "m/s");
  s.number("complete", &S::complete, 0, 1, "least score of a moment, share of the median");
  s.number("least_score", &S::least_score, 0, kAnyPositive, "of a figure in any frame, nats");
  s.integer("candidates", &S::candidates, 1, 1000, "places of a frame that lines go through");
  s.integer("grid_px", &S::grid_px, 1, 1000, "spacing of places at 640 px of image width, px");

  using A = StartConfig;
  ParameterGroup<A> a(table, "start", "the first particles", &Config::tracker,
                      &TrackerConfig::start);
  a.integer("phases", &A::phases, 1, 1000, "hypotheses over the phase of each foot's step");
  a.integer("particles", &A::particles, 1, 10'000'000, "of each hypothesis");
  a.number("seconds", &A::seconds, 0, 10, "for which hypotheses compete, s");
  a.number("heading_deg", &A::heading_deg, 0, 180, "deviation of the first heading, degrees");
  a.number("speed", &A::speed, 0, 2, "deviation of the first speed, relative");
  a.number("step_length", &A::step_length, 0, 2, "deviation of the step length, relative");
}

void add_track(ParameterTable& table) {
  using T = TrackerConfig;
  ParameterGroup<T> t(table, "track", "keeping the track", &Config::tracker);
  t.number("lost_below", &T::lost_below, 0, 1, "share of the likelihood's median");
  t.number("lost_after", &T::lost_after, 0, 100, "time below it until the track is lost, s");
  t.number("beaten_after", &T::beaten_after, 0, 100,
           "time of doing worse than a stiff figure until the track is lost, s");
  t.number("seek", &T::seek, 0, 1000,
           "time for which a lost walker is looked for only within reach, s");
  t.number("model_error", &T::model_error, 0, 100,
           "multiplies what bands hold beyond the particles' spread");
  t.choice("estimate", &T::estimate, {{"mean", EstimateKind::kMean}, {"map", EstimateKind::kMap}},
           "what is reported of a frame: the particles' mean, or the most probable pose near it");
  t.number("recall", &T::recall, 0.1, 100, "past that the median is taken over, s");
  t.integer("samples", &T::samples, 0, 1000,
            "particles of a frame kept: the overlay's, and for bands");
  using L = SmoothingConfig;
  ParameterGroup<L> l(table, "smoothing", "frames in the light of others", &Config::smoothing);
  l.number("lag", &L::lag, 0, 2, "of frames before and after one that count, s; 0 = off");
  l.flag("plant", &L::plant, "feet stay where they stand, above the ground");
  using K = KineticsConfig;
  ParameterGroup<K> k(table, "kinetics", "the forces behind the motion", &Config::kinetics);
  k.number("cutoff_hz", &K::cutoff_hz, 0, 100, "joint centres are smoothed below it, Hz; 0: not");
  k.number("tracked_cutoff_hz", &K::tracked_cutoff_hz, 0, 100, "the same of tracked ones");
  using G = GateConfig;
  ParameterGroup<G> g(table, "gates", "when a result is not good enough", &Config::gates);
  g.number("lost_share", &G::lost_share, 0, 1, "of the frames after the walker was found");
  g.number("untracked_movement", &G::untracked_movement, 0, 1,
           "of the frames in which somebody moves, those without a figure");
  g.number("least_steps", &G::least_steps, 0, 1000, "foot changes that make a walk");
  g.number("overlap", &G::overlap, 0, 1,
           "of figure and foreground, mean over the frames of the worst camera");
  g.number("better_beside", &G::better_beside, 0, 1,
           "by which images speak more for a figure beside the reported one, mean over frames");
  g.number("legs_exchanged", &G::legs_exchanged, 0, 1,
           "mean probability, by the tracker's own account, of left and right being swapped");
  g.number("leg_swaps", &G::leg_swaps, 0, 1e5, "legs swapped between frames, a minute");
  g.number("steps_off_way", &G::steps_off_way, 0, 1000,
           "by which the steps together miss the way of the pelvis, as a share of it");
  g.number("longest_step", &G::longest_step, 0, 1000, "leg lengths");
  g.number("shortest_step", &G::shortest_step, -1000, 1000,
           "along the way, m; below 0 a foot ends behind the other one");
  g.number("fastest", &G::fastest, 0, 1000, "speed over half a second, m/s");
  g.number("foot_slide", &G::foot_slide, 0, 10,
           "of a standing foot, before it is planted, mean over stances, m");
  g.number("penetration", &G::penetration, 0, 10, "deepest foot in the ground, m");
  g.number("jitter", &G::jitter, 0, 1e9, "mean third derivative of the joints, m/s^3");
}

void add_budget(ParameterTable& table) {
  using B = BudgetConfig;
  ParameterGroup<B> b(table, "budget", "particles that follow the clock: no longer deterministic",
                      &Config::budget);
  b.number("frame_ms", &B::frame_ms, 0, kAnyPositive, "that a frame may take, ms; 0 = no budget");
  b.integer("least_particles", &B::least_particles, 1, 10'000'000, "even if frames take longer");
  b.integer("most_particles", &B::most_particles, 1, 10'000'000, "even if there is time");
}

void add_report(ParameterTable& table) {
  using V = OverlayConfig;
  ParameterGroup<V> v(table, "overlay", "videos with the tracked figure", &Config::overlay);
  v.integer("width", &V::width, 0, kMostPixelsAlongASide,
            "larger pictures are shrunk to it, px; 0 = as the video");
  v.flag("crop", &V::crop, "show a window that follows the walker instead of the whole picture");
  v.choice("preset", &V::preset, encoder_presets(),
           "of the encoder: slower ones make smaller files");
  using R = ReportConfig;
  ParameterGroup<R> r(table, "report", "report.html", &Config::report);
  r.number("embed_mb", &R::embed_mb, 0, 1000,
           "overlay videos inside it; larger ones beside it, MB");
  using C = CheckpointConfig;
  ParameterGroup<C> c(table, "checkpoint", "where track --resume goes on", &Config::checkpoint);
  c.number("seconds", &C::seconds, 0, kAnyPositive,
           "of work between checkpoints, s; 0: after each frame");
}

ParameterTable make_table() {
  ParameterTable table;
  add_run(table);
  add_body(table);
  add_observation(table);
  add_motion(table);
  add_filter(table);
  add_search(table);
  add_track(table);
  add_budget(table);
  add_report(table);
  return table;
}

}  // namespace

const ParameterTable& config_table() {
  static const ParameterTable kTable = make_table();
  return kTable;
}

}  // namespace walktrack
