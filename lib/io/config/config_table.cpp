#include "io/config/config_table.h"

#include <limits>
#include <utility>

#include "io/video/image_files.h"
#include "observation/terms.h"

namespace walktrack {
inline namespace io {

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

// Collects the configuration keys that the likelihood terms describe.
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
  ParameterGroup<O> o(table, "observation", "the likelihood of the images", &Config::observation);
  o.number("person_px", &O::person_px, 1, kAnyPositive,
           "height of a standing subject in the shrunk images, px");
  o.number("clip", &O::clip, 0, kAnyPositive, "limit of one pixel's log-likelihood ratio, nats");
  o.number("independent_m", &O::independent_m, 1e-3, 1,
           "side of a patch on the body whose pixels count as one independent observation, m");
  o.number("outline_share", &O::outline_share, 0, 1,
           "share of the outlines' evidence that counts; 0 = a third with keypoints, 1 without");

  TermGroups groups{table};
  Terms::each([&]<typename Term>() { Term::describe(groups); });
}

void add_body(ParameterTable& table) {
  ParameterGroup<BodyGroups> b(table, "body", "which parts of the body are modelled",
                               &Config::body);
  b.flag("head", &BodyGroups::head, "whether head and neck are modelled");
  b.flag("arms", &BodyGroups::arms, "whether the arms are modelled");
}

void add_motion(ParameterTable& table) {
  using M = MotionConfig;
  ParameterGroup<M> m(table, "motion", "the motion model of the walker", &Config::tracker,
                      &TrackerConfig::motion);
  m.choice("model", &M::model,
           {{"kneed", MotionKind::kKneed},
            {"anthropomorphic", MotionKind::kAnthropomorphic},
            {"markov", MotionKind::kMarkov}},
           "dynamics of a particle: the kneed walker, a walker with straight legs, or none");
  m.choice("path", &M::path, {{"spatial", Path::kSpatial}, {"sagittal", Path::kSagittal}},
           "path of the walk: free in space, or a straight line, with all joints moving in its "
           "upright plane");
  m.number("markov_noise_scale", &M::markov_noise_scale, 0, 100,
           "factor on the noise of model markov");
  m.number("torso_torque", &M::torso_torque, 0, 10, "noise of the torso torque, M g L per sqrt(s)");
  m.number("hip_torque", &M::hip_torque, 0, 10, "noise of the hip torque, M g L per sqrt(s)");
  m.number("stance_knee_torque", &M::stance_knee_torque, 0, 10,
           "noise of the stance knee torque, M g L per sqrt(s)");
  m.number("swing_knee_torque", &M::swing_knee_torque, 0, 10,
           "noise of the swing knee torque, M g L per sqrt(s)");
  m.number("ankle_torque", &M::ankle_torque, 0, 10, "noise of the ankle torque, M g L per sqrt(s)");
  m.number("torque_noise_scale", &M::torque_noise_scale, 0, 1000,
           "factor on the noise of all five torques");
  m.number("phase_noise", &M::phase_noise, 0, 1,
           "random drift of the phase of the stride, s per sqrt(s)");
  m.number("yaw_rate_sd", &M::yaw_rate_sd, 0, 100,
           "standard deviation of the rate of turning, rad/s");
  m.number(
      "turning_yaw_rate_sd", &M::turning_yaw_rate_sd, 0, 100,
      "the same of filters that are tried before one camera where the subject may turn, rad/s; "
      "0: none");
  m.number("heading_time_constant", &M::heading_time_constant, 0.01, 1000,
           "time constant with which the heading returns to the direction of travel, s");
  m.number("residual_scale", &M::residual_scale, 0, 10,
           "factor on the residual angles, by which a person differs from the walker");
  m.number("ball_drift", &M::ball_drift, 0, 1,
           "drift of the stance foot along the walk, m per sqrt(s)");
  m.number("ball_slip", &M::ball_slip, 0, 1,
           "drift of the stance foot across the walk, m per sqrt(s)");
  m.number("footfall_sd", &M::footfall_sd, 0, 1,
           "standard deviation of the place of a footfall, m");
  m.number("footfall_decay", &M::footfall_decay, 1e-3, 10,
           "time in which the uncertainty of a footfall decays, s");
  m.number("start_position_sd", &M::start_position_sd, 0, 10,
           "standard deviation of the first foot's place, m");
  m.number("given_position_sd", &M::given_position_sd, 0, 10,
           "standard deviation of the place that the scene states as `initial`, m");
  m.number("control_noise", &M::control_noise, 0, 1,
           "relative noise of the walker's controls, per step");
  m.number("feedback", &M::feedback, 0, 1,
           "strength of the correction of controls at a change of the stance foot");
  m.number("aim_drift", &M::aim_drift, 0, 1,
           "relative drift of the speed and step length aimed at, per step");
  m.number("phase_jump_rate", &M::phase_jump_rate, 0, 100,
           "rate at which particles propose another phase of the stride for their pose, 1/s");
  m.flag("standing", &M::standing, "whether the subject may stand, set off and stop");
}

void add_filter(ParameterTable& table) {
  using F = FilterConfig;
  ParameterGroup<F> f(table, "filter", "the particle filter", &Config::tracker,
                      &TrackerConfig::filter);
  f.integer("particles", &F::particles, 0, 10'000'000,
            "number of particles; 0 = 200 with one or two cameras, 100 with more");
  f.number("resample_below", &F::resample_below, 0, 1,
           "effective share of the particles below which they are resampled");
  f.number("layer_ess", &F::layer_ess, 0, 1,
           "share of the effective sample size that a tempered layer keeps");
  f.integer("max_layers", &F::max_layers, 1, 1000,
            "most tempered layers of a frame; 1 = no tempering");
  f.integer("moves", &F::moves, 0, 1000,
            "Metropolis-Hastings moves of a particle after each layer");
}

void add_search(ParameterTable& table) {
  using S = DetectorConfig;
  ParameterGroup<S> s(table, "detector", "finding the subject in a window of frames",
                      &Config::tracker, &TrackerConfig::detector);
  s.number("window", &S::window, 0.1, 10, "length of video in which a walk is searched, s");
  s.number("slowest", &S::slowest, 0, 10, "lowest speed of a walk, m/s");
  s.number("fastest", &S::fastest, 0.1, 20, "highest speed of a walk, m/s");
  s.number("least_share", &S::least_share, 0, 1,
           "lowest score of a frame, as a share of the median over the window");
  s.number("least_score", &S::least_score, 0, kAnyPositive,
           "lowest score of the figure in any frame, if outlines count in full; nats");
  s.number("least_points_score", &S::least_points_score, 0, kAnyPositive,
           "the same for keypoints without video, nats");
  s.integer("candidates", &S::candidates, 1, 1000,
            "places of a frame through which straight walks are proposed");
  s.integer("grid_px", &S::grid_px, 1, 1000,
            "spacing of the searched places at 640 px of image width, px");

  using A = StartConfig;
  ParameterGroup<A> a(table, "start", "the first particles", &Config::tracker,
                      &TrackerConfig::start);
  a.integer("phases", &A::phases, 1, 1000, "start hypotheses over the phase of each foot's step");
  a.integer("particles", &A::particles, 0, 10'000'000,
            "particles of each start hypothesis; 0 = 150 with one or two cameras, 75 with more");
  a.number("seconds", &A::seconds, 0, 10, "time in which the start hypotheses compete, s");
  a.number("heading_deg", &A::heading_deg, 0, 180,
           "standard deviation of the first heading, degrees");
  a.number("speed", &A::speed, 0, 2, "relative standard deviation of the first speed");
  a.number("step_length", &A::step_length, 0, 2,
           "relative standard deviation of the first step length");
}

void add_track(ParameterTable& table) {
  using T = TrackerConfig;
  ParameterGroup<T> t(table, "track", "when a track is lost, and what is reported",
                      &Config::tracker);
  using M = MonitorConfig;
  ParameterGroup<M> m(table, "track", "", &Config::tracker, &T::monitor);
  m.number("lost_below", &M::lost_below, 0, 1,
           "share of the log-likelihood's median below which a frame counts as lost");
  m.number("lost_after", &M::lost_after, 0, 100,
           "time below lost_below after which the track is lost, s");
  m.number("outscored_after", &M::outscored_after, 0, 100,
           "time after which the track is lost if its likelihood is lower than that of a rigid "
           "figure, s");
  m.number(
      "off_detected_after", &M::off_detected_after, 0, 100,
      "time after which the track is lost if the figure lies on none of the detected people, s");
  m.number("reacquire_within", &M::reacquire_within, 0, 1000,
           "time for which a lost subject is searched only within walking distance, s");
  t.flag("others", &T::others,
         "whether other people near the subject are followed, so that their pixels do not count");
  t.number("model_error", &T::model_error, 0, 100,
           "factor on the part of the 90 % bands that is not the particles' spread");
  t.choice("estimate", &T::estimate,
           {{"filter", EstimateKind::kFilter},
            {"map", EstimateKind::kMap},
            {"mean", EstimateKind::kFilter}},
           "reported poses: of the filter, which are the particles' means, or the most probable "
           "ones of the whole video");
  m.number("evidence_window", &M::evidence_window, 0.1, 100,
           "length of the past whose median likelihood a frame is compared with, s");
  t.integer("samples", &T::samples, 0, 1000,
            "particles of a frame that are kept for overlays and bands");
  using L = SmoothingConfig;
  ParameterGroup<L> l(table, "smoothing", "the poses of the whole video, estimated together",
                      &Config::smoothing);
  l.flag("enabled", &L::enabled,
         "whether the most probable poses of all frames together are reported");
  l.flag("plant", &L::plant, "whether stance feet are held in place and above the ground then");
  using K = KineticsConfig;
  ParameterGroup<K> k(table, "kinetics", "ground reaction forces and joint moments",
                      &Config::kinetics);
  k.number("cutoff_hz", &K::cutoff_hz, 0, 100,
           "cut-off frequency of the joint centres of motion capture, Hz; 0 = not filtered");
  k.number("tracked_cutoff_hz", &K::tracked_cutoff_hz, 0, 100,
           "cut-off frequency of tracked joint centres, Hz; 0 = not filtered");
  using G = QualityConfig;
  ParameterGroup<G> g(table, "quality", "limits of the quality checks", &Config::quality);
  g.number("lost_share", &G::lost_share, 0, 1,
           "most lost frames, as a share of those after the subject was found");
  g.number("untracked_movement", &G::untracked_movement, 0, 1,
           "most untracked frames, as a share of those in which somebody moves");
  g.number("frame_rate", &G::frame_rate, 0, 1000, "lowest frame rate, Hz");
  g.number("least_steps", &G::least_steps, 0, 1000, "fewest steps of a walk");
  g.number("overlap", &G::overlap, 0, 1,
           "lowest overlap of figure and foreground, mean over the frames of the worst camera");
  g.number(
      "better_beside_nats", &G::better_beside_nats, 0, 1e5,
      "most evidence by which a figure beside the reported one is better, nats a picture, mean");
  g.number(
      "on_detected", &G::on_detected, 0, 1,
      "smallest share of the frames with keypoints in which the figure is on a detected person");
  g.number("legs_swapped", &G::legs_swapped, 0, 1,
           "largest mean probability, estimated by the tracker, that left and right are swapped");
  g.number("leg_swaps", &G::leg_swaps, 0, 1e5,
           "most swaps of left and right between frames, per minute");
  g.number("steps_off_way", &G::steps_off_way, 0, 1000,
           "largest difference between the sum of the steps and the path of the pelvis, as a share "
           "of the path");
  g.number("missing_steps", &G::missing_steps, 0, 1000,
           "most steps that are missing on the path of the pelvis");
  g.number("longest_step", &G::longest_step, 0, 1000, "longest step, leg lengths");
  g.number("shortest_step", &G::shortest_step, -1000, 1000,
           "shortest step along the walk, m; below 0 a foot ends behind the other one");
  g.number("quickest_step", &G::quickest_step, 0, 1,
           "shortest time of a step, as a share of the usual one");
  g.number("fastest", &G::fastest, 0, 1000, "highest speed over half a second, m/s");
  g.number("foot_slide", &G::foot_slide, 0, 10,
           "largest slide of a stance foot along the walk before it is held in place, mean over "
           "stances, m; 0 = 0.07 with one camera, 0.1 with more");
  g.number("penetration", &G::penetration, 0, 10, "largest depth of a foot below the ground, m");
  g.number("jitter", &G::jitter, 0, 1e9,
           "largest mean third derivative of the joint centres, m/s^3");
}

void add_budget(ParameterTable& table) {
  using B = BudgetConfig;
  ParameterGroup<B> b(table, "budget",
                      "particles adapted to a time per frame: results are no longer deterministic",
                      &Config::budget);
  b.number("frame_ms", &B::frame_ms, 0, kAnyPositive,
           "time that a frame may take, ms; 0 = no budget");
  b.integer("least_particles", &B::least_particles, 1, 10'000'000,
            "fewest particles, even if frames take longer");
  b.integer("most_particles", &B::most_particles, 1, 10'000'000,
            "most particles, even if there is time");
}

void add_report(ParameterTable& table) {
  using V = OverlayConfig;
  ParameterGroup<V> v(table, "overlay", "videos with the tracked figure", &Config::overlay);
  v.integer("width", &V::width, 0, kMostPixelsAlongASide,
            "width to which larger images are shrunk, px; 0 = as the video");
  v.flag("crop", &V::crop,
         "whether overlays show a window that follows the subject instead of the whole image");
  v.choice("preset", &V::preset, encoder_presets(),
           "preset of the encoder: slower ones make smaller files");
  using R = ReportConfig;
  ParameterGroup<R> r(table, "report", "report.html", &Config::report);
  r.number("embed_mb", &R::embed_mb, 0, 1000,
           "size up to which overlay videos are inside the report, MB; larger ones stay beside it");
  using C = CheckpointConfig;
  ParameterGroup<C> c(table, "checkpoint", "checkpoints from which track --resume continues",
                      &Config::checkpoint);
  c.number("seconds", &C::seconds, 0, kAnyPositive,
           "time between checkpoints, s; 0 = after each frame");
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

}  // namespace io
}  // namespace walktrack
