#include "tests/regression/clip.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

#include <nlohmann/json.hpp>

#include "core/errors.h"
#include "io/tables/csv.h"
#include "metrics/gait.h"
#include "metrics/plausibility.h"
#include "tests/data_folders.h"

namespace walktrack {

namespace {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();
constexpr double kPercent = 100, kMm = 1000;
constexpr int kSettled = 6, kMeanOf = 8;  // frames after a landing, and how many are its place

double known_or_none(double value) { return value > 0 ? value : kNotKnown; }

double share(const std::vector<bool>& of) {
  if (of.empty()) return kNotKnown;
  return static_cast<double>(std::ranges::count(of, true)) / static_cast<double>(of.size());
}

// Mean place of a toe while it stands after a landing; NaN where it is not known.
Eigen::Vector2d toe_after(const Landing& landing, Side side, double rate, const Motion& motion) {
  const double half = 0.5 / rate;
  const double from = landing.time + kSettled / rate - half, to = from + kMeanOf / rate;
  Eigen::Vector2d sum = Eigen::Vector2d::Zero();
  int count = 0;
  for (size_t i = 0; i < motion.time.size(); ++i) {
    const Eigen::Vector3d& at = motion.joints[i][toe(side)];
    if (motion.time[i] < from || motion.time[i] >= to || !known(at)) continue;
    sum += at.head<2>();
    ++count;
  }
  return sum / count;
}

void add_landings(const ClipFacts& facts, const Motion& motion, FigureValues& out) {
  double errors = 0;
  int found = 0, on_side = 0;
  for (const Landing& landing : facts.landings) {
    const auto away = [&](Side side) {
      return (toe_after(landing, side, facts.run.rate, motion) - landing.place).norm();
    };
    const double own = away(landing.side);
    if (std::isnan(own)) continue;
    errors += own;
    ++found;
    on_side += own <= away(other(landing.side));
  }
  out["toes_on_side"] = on_side;
  out["toe_error_mean_mm"] = found > 0 ? kMm * errors / found : kNotKnown;
}

void add_gait(const Motion& motion, FigureValues& out) {
  const Gait gait = gait_from_motion(motion);
  const Plausibility p = plausibility(motion, gait);
  out["speed_m_s"] = known_or_none(gait.speed);
  out["step_length_m"] = known_or_none(gait.mean_step_length);
  out["step_time_s"] = known_or_none(gait.mean_step_time);
  out["foot_slide_mean_mm"] = p.stances > 0 ? kMm * p.mean_foot_slide : kNotKnown;
  out["penetration_mm"] = kMm * p.penetration;
  out["jitter_m_s3"] = p.jitter;
}

void add_standing(const ClipFacts& facts, const Motion& motion, FigureValues& out) {
  const auto stands = [&](double t) { return t < facts.sets_off || t > facts.stands_again; };
  const auto events = gait_from_motion(motion).events;
  out["events_in_standing"] = static_cast<double>(
      std::ranges::count_if(events, [&](const GaitEvent& event) { return stands(event.time); }));
  std::vector<bool> stood;
  for (size_t i = 0; i < facts.run.standing.size(); ++i)
    if (static_cast<double>(i) / facts.run.rate < facts.sets_off)
      stood.push_back(facts.run.standing[i] > 0.5);
  out["standing_percent"] = kPercent * share(stood);
}

}  // namespace

std::filesystem::path file_of(std::string_view below_shared_data) {
  return kSharedData / below_shared_data;
}

bool is_there(const Clip& clip) { return std::filesystem::exists(file_of(clip.scene)); }

bool holds_landings(std::string_view truth) { return truth.ends_with("toe_plants.csv"); }

std::vector<Landing> read_landings(const std::filesystem::path& file, int first_frame,
                                   double rate) {
  const CsvTable table = read_csv(file);
  const size_t side = table.column("side"), frame = table.column("on_frame");
  const size_t x = table.column("toe_x_m"), y = table.column("toe_y_m");
  std::vector<Landing> out;
  for (const CsvTable::Row& row : table.rows) {
    const double after = table.number(row, frame) - first_frame;
    if (after < 0) continue;
    out.push_back({row.cells[side] == "left" ? Side::kLeft : Side::kRight,
                   after / rate,
                   {table.number(row, x), table.number(row, y)}});
  }
  return out;
}

ClipRun clip_run(const TrackOutcome& outcome, const nlohmann::json& run) {
  ClipRun out;
  out.passed = outcome.status == TrackStatus::kTracked;
  out.steps = outcome.walk.steps;
  const nlohmann::json& numbers = run.at("numbers");
  out.rate = numbers.at("frame_rate");
  out.tracked_share = static_cast<double>(outcome.tracked) / outcome.frames;
  out.first_tracked =
      outcome.tracked > 0 ? numbers.at("first_tracked_frame").get<double>() / out.rate : kNotKnown;
  for (const nlohmann::json& value : run.at("by_frame").at("standing"))
    out.standing.push_back(value.is_number() ? value.get<double>() : kNotKnown);
  return out;
}

ClipFacts facts_of(const Clip& clip, int first_frame, ClipRun run) {
  ClipFacts out;
  out.walks = !clip.truth.empty();
  out.run = std::move(run);
  if (holds_landings(clip.truth))
    out.landings = read_landings(file_of(clip.truth), first_frame, out.run.rate);
  if (clip.walking) {
    out.sets_off = (clip.walking->first - first_frame) / out.run.rate;
    out.stands_again = (clip.walking->last - first_frame) / out.run.rate;
  }
  return out;
}

FigureValues clip_figures(const ClipFacts& facts, const Motion& estimate) {
  FigureValues out;
  if (!facts.walks) {
    out["invented_steps"] = static_cast<double>(facts.run.steps);
    out["invented_walks"] = facts.run.passed;
    return out;
  }
  out["passed"] = facts.run.passed;
  out["tracked_percent"] = kPercent * facts.run.tracked_share;
  out["first_tracked_s"] = facts.run.first_tracked;
  if (!facts.landings.empty()) {
    add_landings(facts, estimate, out);
    add_gait(estimate, out);
  }
  if (facts.stands_again > facts.sets_off) add_standing(facts, estimate, out);
  return out;
}

}  // namespace walktrack
