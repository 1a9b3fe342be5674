#include "jobs/prior/prior_pictures.h"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace walktrack {
inline namespace jobs {
namespace {

constexpr const char* kStance = "#0072b2";  // Okabe & Ito 2008, for colour-blind people
constexpr const char* kSwing = "#d55e00";
constexpr const char* kInk = "#333333";

std::string svg(double width, double height, const std::string& body) {
  return fmt::format(
      "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 {0} {1}\" width=\"{0}\" "
      "height=\"{1}\" font-family=\"sans-serif\" font-size=\"12\">\n"
      "<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n{2}</svg>\n",
      width, height, body);
}

std::string text(double x, double y, const std::string& words, const char* anchor = "middle") {
  return fmt::format("<text x=\"{:.1f}\" y=\"{:.1f}\" fill=\"{}\" text-anchor=\"{}\">{}</text>\n",
                     x, y, kInk, anchor, words);
}

std::string line(Vector2 a, Vector2 b, const char* colour, double width = 2) {
  return fmt::format(
      "<line x1=\"{:.2f}\" y1=\"{:.2f}\" x2=\"{:.2f}\" y2=\"{:.2f}\" stroke=\"{}\" "
      "stroke-width=\"{}\" stroke-linecap=\"round\"/>\n",
      a.x(), a.y(), b.x(), b.y(), colour, width);
}

// A plot area with linear axes from data to pixels.
struct Plot {
  double left = 60, top = 20, width = 480, height = 320;
  Vector2 low, high;

  Vector2 at(double x, double y) const {
    return {left + width * (x - low.x()) / (high.x() - low.x()),
            top + height * (1 - (y - low.y()) / (high.y() - low.y()))};
  }

  std::string axes(const std::string& x_name, const std::string& y_name) const {
    constexpr double kTick = 0.2;
    std::string out = line(at(low.x(), low.y()), at(high.x(), low.y()), kInk, 1) +
                      line(at(low.x(), low.y()), at(low.x(), high.y()), kInk, 1);
    for (double x = std::ceil(low.x() / kTick) * kTick; x <= high.x(); x += kTick)
      out += text(at(x, 0).x(), top + height + 16, fmt::format("{:.1f}", x));
    for (double y = std::ceil(low.y() / kTick) * kTick; y <= high.y(); y += kTick)
      out += text(left - 6, at(0, y).y() + 4, fmt::format("{:.1f}", y), "end");
    return out + text(left + width / 2, top + height + 34, x_name) + text(left, top - 6, y_name);
  }
};

Plot speed_step_plot() { return {.low = {0.4, 0.2}, .high = {2.4, 1.3}}; }

// Dark blue over green to yellow, close to viridis.
std::string shade(double share) {
  const double s = std::clamp(share, 0.0, 1.0);
  const auto mix = [&](double a, double b, double c) {
    return static_cast<int>(s < 0.5 ? a + 2 * s * (b - a) : b + (2 * s - 1) * (c - b));
  };
  return fmt::format("rgb({},{},{})", mix(68, 33, 253), mix(1, 145, 231), mix(84, 140, 37));
}

// Limits of a node's cell on an axis, half way to its neighbours.
std::pair<double, double> cell(const std::vector<double>& axis, size_t i) {
  const double below = i > 0 ? axis[i] - axis[i - 1] : axis[1] - axis[0];
  const double above = i + 1 < axis.size() ? axis[i + 1] - axis[i] : below;
  return {axis[i] - below / 2, axis[i] + above / 2};
}

std::string figure(const KneedPosture& p, const Vector2& origin, double scale, bool left_stance) {
  const auto at = [&](const Vector2& point) -> Vector2 {
    return {origin.x() + scale * point.x(), origin.y() - scale * point.y()};
  };
  const char* stance = left_stance ? kStance : kSwing;
  const char* swing = left_stance ? kSwing : kStance;
  const Vector2 shoulder = p.hip + 1.6 * (p.torso_com - p.hip);
  return line(at(p.hip), at(shoulder), kInk) + line(at(p.hip), at(p.swing_knee), swing) +
         line(at(p.swing_knee), at(p.swing_ankle), swing) +
         line(at(p.hip), at(p.stance_knee), stance) +
         line(at(p.stance_knee), at(p.stance_ankle), stance);
}

std::string strip(const GaitPrior& prior, const KneedParameters& walker, double speed, double y,
                  const std::string& name) {
  constexpr int kFigures = 7, kSteps = 2;
  constexpr double kScale = 90, kLeft = 120;
  const WalkerUnits units = walker_units(walker);
  const KneedModel model = kneed_model(walker);
  const double step = units.length * preferred_step_length(speed / units.speed());
  const PriorGait gait = gait_at(prior, walker, speed, step);
  std::string out = text(10, y - 60, name, "start");
  KneedState state = gait.start;
  KneedControls controls = gait.controls;
  for (int i = 0; i < kSteps * kFigures; ++i) {
    // Figures are drawn further apart than they walk, so that they do not overlap.
    const double shift = kLeft + 45.0 * i - kScale * kneed_posture(model, state).hip.x();
    out += figure(kneed_posture(model, state), {shift, y}, kScale, state.transfers % 2 == 0);
    double left = gait.period / kFigures;
    while (left > 0) {
      const KneedAdvance run = kneed_advance(model, controls, Vector5::Zero(), state, left);
      if (run.event == KneedEvent::kFallen || run.event == KneedEvent::kDiverged) return out;
      if (run.event == KneedEvent::kTransfer) controls = next_controls(gait, state);
      left -= run.event == KneedEvent::kNone ? left : run.elapsed;
    }
  }
  return out + line({kLeft - 40, y}, {kLeft + 45.0 * kSteps * kFigures, y}, kInk, 0.5);
}

}  // namespace

std::string cost_picture(const CostTable& prior, const WalkerUnits& units) {
  const Plot plot = speed_step_plot();
  const size_t level = nearest_index(prior.slopes, 0);
  constexpr double kDearest = 0.2;  // cost of transport with the darkest colour
  std::string body;
  for (size_t i = 0; i < prior.speeds.size(); ++i)
    for (size_t j = 0; j < prior.ratios.size(); ++j) {
      const CostNode& node = prior.node(i, j, level);
      if (!node.valid) continue;
      const double preferred = units.length * preferred_step_length(prior.speeds[i]);
      const auto [slow, fast] = cell(prior.speeds, i);
      const auto [shorter, longer] = cell(prior.ratios, j);
      const Vector2 a = plot.at(slow * units.speed(), longer * preferred);
      const Vector2 b = plot.at(fast * units.speed(), shorter * preferred);
      body += fmt::format(
          "<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.1f}\" height=\"{:.1f}\" fill=\"{}\">"
          "<title>{:.3f}</title></rect>\n",
          a.x(), a.y(), b.x() - a.x(), b.y() - a.y(), shade(node.cost / kDearest), node.cost);
    }
  for (int i = 0; i <= 4; ++i)
    body += fmt::format("<rect x=\"570\" y=\"{}\" width=\"20\" height=\"40\" fill=\"{}\"/>\n",
                        180 - 40 * i, shade(0.25 * i)) +
            text(610, 205 - 40 * i, fmt::format("{:.2f}", kDearest * 0.25 * i));
  body += text(600, 240, "cost of transport");
  return svg(660, 400, body + plot.axes("speed, m/s", "step length, m"));
}

std::vector<CheapestStep> cheapest_steps(const CostTable& prior, const WalkerUnits& units) {
  std::vector<CheapestStep> steps;
  const size_t level = nearest_index(prior.slopes, 0);
  for (size_t i = 0; i < prior.speeds.size(); ++i) {
    std::optional<size_t> best;
    const auto cost = [&](size_t j) { return prior.node(i, j, level).cost; };
    const auto valid = [&](size_t j) { return prior.node(i, j, level).valid; };
    for (size_t j = 0; j < prior.ratios.size(); ++j)
      if (valid(j) && (!best || cost(j) < cost(*best))) best = j;
    if (!best || *best == 0 || *best + 1 == prior.ratios.size() || !valid(*best - 1) ||
        !valid(*best + 1))
      continue;
    const double before = cost(*best - 1), here = cost(*best), after = cost(*best + 1);
    const double width = prior.ratios[*best + 1] - prior.ratios[*best];
    const double shift = 0.5 * (before - after) / (before - 2 * here + after);
    const double ratio = prior.ratios[*best] + shift * width;
    steps.push_back({prior.speeds[i] * units.speed(),
                     ratio * preferred_step_length(prior.speeds[i]) * units.length,
                     here - 0.25 * (before - after) * shift});
  }
  return steps;
}

std::string cheapest_picture(const std::vector<CheapestStep>& steps, const WalkerUnits& units) {
  const Plot plot = speed_step_plot();
  std::string body;
  constexpr double kFirst = 0.5, kLast = 2.2, kWidth = 0.05;
  const auto preferred = [&](double speed) {
    return plot.at(speed, units.length * preferred_step_length(speed / units.speed()));
  };
  for (double v = kFirst; v < kLast; v += kWidth)
    body += line(preferred(v), preferred(v + kWidth), kStance, 1.5);
  for (const CheapestStep& step : steps) {
    const Vector2 at = plot.at(step.speed, step.step_length);
    body += fmt::format("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"4\" fill=\"{}\"/>\n", at.x(),
                        at.y(), kSwing);
  }
  body += text(300, 60, "line: people; dots: cheapest in the table", "start");
  return svg(600, 400, body + plot.axes("speed, m/s", "step length, m"));
}

std::string strips_picture(const GaitPrior& prior, const KneedParameters& walker) {
  const auto on_slope = [&](double slope) {
    KneedParameters tilted = walker;
    tilted.slope = slope;
    return tilted;
  };
  constexpr double kHill = 0.06;  // rad
  return svg(800, 900,
             strip(prior, on_slope(0), 0.8, 170, "slow, 0.8 m/s") +
                 strip(prior, on_slope(0), 1.3, 340, "normal, 1.3 m/s") +
                 strip(prior, on_slope(0), 1.9, 510, "fast, 1.9 m/s") +
                 strip(prior, on_slope(-kHill), 1.2, 680, "up 6 %") +
                 strip(prior, on_slope(kHill), 1.2, 850, "down 6 %"));
}

}  // namespace jobs
}  // namespace walktrack
