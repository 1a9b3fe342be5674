#include "io/config_table.h"

#include <limits>

namespace walktrack {

namespace {

constexpr double kAnyPositive = 1e9;
constexpr int kMostThreads = 4096;

void add_run(ParameterTable& table) {
  ParameterGroup<Config> top(table, "", "the run");
  top.integer("seed", &Config::seed, 0, std::numeric_limits<int64_t>::max(),
              "seed of all random numbers");
  top.integer("threads", &Config::threads, 0, kMostThreads, "threads, 0 = all of the machine");
}

void add_observation(ParameterTable& table) {
  using O = ObservationConfig;
  ParameterGroup<O> o(table, "observation", "how images become likelihoods", &Config::observation);
  o.number("person_px", &O::person_px, 1, kAnyPositive,
           "images are shrunk while a standing subject stays this high, px");
  o.number("clip", &O::clip, 0, kAnyPositive, "what one pixel may say at most, nats");
  o.number("independent_m", &O::independent_m, 1e-3, 1,
           "side of a patch on the body that counts as one independent pixel, m");

  using B = BackgroundConfig;
  ParameterGroup<B> b(table, "observation.background", "the empty scene", &Config::observation,
                      &O::background);
  b.flag("enabled", &B::enabled, "whether the background is modelled");
  b.integer("samples", &B::samples, 1, 10'000, "frames that the model is made of");
  b.number("noise", &B::noise, 0.1, 255, "smallest deviation of a channel, grey levels of 256");
  b.number("jitter_px", &B::jitter_px, 0, 100, "how far edges move about, px of the shrunk image");
  b.number("shadow_darkest", &B::shadow_darkest, 0, 1, "share of its value that a shadow leaves");
  b.number("shadow_share", &B::shadow_share, 0, 1, "prior probability of a shadow");
  b.number("shadow_tint", &B::shadow_tint, 0.1, 255, "deviation of a shadow's chroma, grey levels");
  b.number("unknown_share", &B::unknown_share, 0, 1, "of the background looking like nothing seen");
  b.number("drift_rate", &B::drift_rate, 0, 1, "share of a frame that the model takes on");

  using F = ForegroundConfig;
  ParameterGroup<F> f(table, "observation.foreground", "how the walker looks", &Config::observation,
                      &O::foreground);
  f.flag("enabled", &F::enabled, "whether appearance is modelled");
  f.list("classes", &F::classes, 0, kAppearanceCount - 1,
         "models of trunk, legs, feet, head, arms; equal numbers share one");
  f.number("broad_share", &F::broad_share, 0, 1, "of a model that expects any colour");
  f.number("prior_pixels", &F::prior_pixels, 0, kAnyPositive, "weight of any colour, pixels");
  f.number("learning_rate", &F::learning_rate, 0, 1, "share of a new frame in the recent half");
  f.number("anchor_share", &F::anchor_share, 0, 1, "share of the first frames, never forgotten");

  using W = FlowConfig;
  ParameterGroup<W> w(table, "observation.flow", "optical flow", &Config::observation, &O::flow);
  w.flag("enabled", &W::enabled, "whether flow is measured");
  w.integer("step_px", &W::step_px, 1, 1000, "between measured points, px of the shrunk image");
  w.number("error_px", &W::error_px, 1e-3, 1000, "scale of the error of a textured point, px");
  w.number("error_share", &W::error_share, 0, 10, "scale of the error, share of the motion");
  w.number("noise", &W::noise, 0.01, 255, "of grey values, which texture has to exceed");
  w.number("dof", &W::dof, 0.5, 1000, "of the Student-t; smaller expects more outliers");
  w.number("weight", &W::weight, 0, 1000, "against the silhouettes");
}

ParameterTable make_table() {
  ParameterTable table;
  add_run(table);
  add_observation(table);
  return table;
}

}  // namespace

const ParameterTable& config_table() {
  static const ParameterTable kTable = make_table();
  return kTable;
}

}  // namespace walktrack
