#include "jobs/sweep/sweep_report.h"

#include <algorithm>
#include <cmath>
#include <functional>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/version.h"
#include "io/config/text.h"
#include "io/drawing/trade_plot.h"

namespace walktrack {
inline namespace jobs {

namespace {

using Json = nlohmann::ordered_json;

// A setting counts as equal to the best one if its error is at most this many times as large.
constexpr double kAsGood = 1.1;
constexpr double kMilliseconds = 1000, kPerHundred = 100;

std::string number(double value, int decimals) {
  return std::isnan(value) ? "-" : fmt::format("{:.{}f}", value, decimals);
}

std::string csv_value(double value, int decimals) {
  return std::isnan(value) ? "" : fmt::format("{:.{}f}", value, decimals);
}

Json json_value(double value) { return std::isnan(value) ? Json() : Json(value); }

std::string name_of(const SweepReport& report, const SweepRow& row) {
  const std::string name = setting_name(report.parameters, row.setting);
  return name.empty() ? "as configured" : name;
}

std::string in_words(const SweepReport& report, const SweepRow& row) {
  const std::string sd =
      std::isnan(row.error_sd_mm) ? "" : fmt::format(" ± {:.1f}", row.error_sd_mm);
  return fmt::format("{}: {:.1f}{} mm at {:.3g} frames/s", name_of(report, row), row.error_mm, sd,
                     row.frames_per_second());
}

// The first row of the front in the order `before` among those that `wanted` accepts; nullptr if
// there is none.
using Compare = std::function<bool(const SweepRow&, const SweepRow&)>;
const SweepRow* best(const SweepReport& report, const std::function<bool(const SweepRow&)>& wanted,
                     const Compare& before) {
  const SweepRow* found = nullptr;
  for (const SweepRow& row : report.rows)
    if (row.on_front && wanted(row) && (!found || before(row, *found))) found = &row;
  return found;
}

bool faster(const SweepRow& a, const SweepRow& b) {
  return a.seconds_per_frame < b.seconds_per_frame;
}
bool closer(const SweepRow& a, const SweepRow& b) { return a.error_mm < b.error_mm; }
bool any(const SweepRow&) { return true; }

std::string options(const SweepReport& report, const SweepRow& row) {
  const SettingWords words = setting_words(report.parameters, row.setting);
  std::string text = words.config.empty() ? "" : " -c " + words.config;
  for (const auto& [key, value] : words.parameters) text += fmt::format(" --set {}={}", key, value);
  if (!words.cameras.empty()) text += fmt::format(" (of the scene's cameras: {})", words.cameras);
  return text;
}

void advise_wishes(const SweepReport& report, const SweepWish& wish,
                   std::vector<std::string>& out) {
  if (wish.frames_per_second) {
    const double fps = *wish.frames_per_second;
    const SweepRow* row = best(
        report, [&](const SweepRow& r) { return r.frames_per_second() >= fps; }, closer);
    out.push_back(
        row ? fmt::format("For {:g} frames/s use {}.", fps, in_words(report, *row))
            : fmt::format("None of these settings reaches {:g} frames/s on this machine.", fps));
    if (row) out.push_back("Its options:" + options(report, *row));
  }
  if (wish.error_mm) {
    const double error = *wish.error_mm;
    const SweepRow* row = best(
        report, [&](const SweepRow& r) { return r.error_mm <= error; }, faster);
    out.push_back(
        row ? fmt::format("For an error of at most {:g} mm use {}.", error, in_words(report, *row))
            : fmt::format("None of these settings comes within {:g} mm.", error));
    if (row) out.push_back("Its options:" + options(report, *row));
  }
}

std::string times_are(const SweepReport& report) {
  return fmt::format(
      "Times are those of this machine with {} thread{}, from decoding to the estimate, without "
      "overlay and report; medians over the runs. CPU ms is the work of all threads, which other "
      "programs on the machine hardly change.",
      report.threads, report.threads == 1 ? "" : "s");
}

std::string errors_are(const SweepReport& report) {
  return fmt::format("Error: {}, against {}; mean ± standard deviation over {} seed{}.",
                     report.error_is, report.reference, report.seeds,
                     report.seeds == 1 ? "" : "s") +
         (report.against_truth ? ""
                               : " There is no truth: errors contain those of that run, and what "
                                 "all settings have in common is not seen.");
}

}  // namespace

std::vector<std::string> sweep_advice(const SweepReport& report, const SweepWish& wish) {
  std::vector<std::string> out;
  const SweepRow* closest = best(report, any, closer);
  if (!closest) return {"No setting keeps the track for every seed: nothing can be recommended."};
  out.push_back(fmt::format("Most accurate: {}.", in_words(report, *closest)));
  const double enough = kAsGood * closest->error_mm;
  const SweepRow* near = best(
      report, [&](const SweepRow& r) { return r.error_mm <= enough; }, faster);
  if (near != closest)
    out.push_back(fmt::format("Fastest within 10 % of that error: {}.", in_words(report, *near)));
  const SweepRow* fastest = best(report, any, faster);
  if (fastest != near)
    out.push_back(fmt::format("Fastest that keeps the track: {}.", in_words(report, *fastest)));
  advise_wishes(report, wish, out);
  return out;
}

std::string sweep_csv(const SweepReport& report) {
  std::string text;
  for (const SweptParameter& parameter : report.parameters) text += csv_cell(parameter.name) + ",";
  text +=
      "error_mm,error_sd_mm,lost_percent,seconds_per_frame,cpu_seconds_per_frame,frames_per_second,"
      "seeds,holds,"
      "on_front\n";
  for (const SweepRow& row : report.rows) {
    for (const std::string& value : row.setting) text += csv_cell(value) + ",";
    text += fmt::format("{},{},{},{:.6f},{:.6f},{:.3f},{},{},{}\n", csv_value(row.error_mm, 3),
                        csv_value(row.error_sd_mm, 3), csv_value(kPerHundred * row.lost_share, 2),
                        row.seconds_per_frame, row.cpu_seconds_per_frame, row.frames_per_second(),
                        row.runs.size(), row.holds ? 1 : 0, row.on_front ? 1 : 0);
  }
  return text;
}

std::string sweep_json(const SweepReport& report, const std::vector<std::string>& advice) {
  const BuildFacts& facts = build_facts();
  Json root = {{"program", {{"version", facts.version}, {"commit", facts.commit}}},
               {"scene", report.scene},
               {"error_is", report.error_is},
               {"reference", report.reference},
               {"against_truth", report.against_truth},
               {"threads", report.threads},
               {"complete", !report.interrupted},
               {"settings", Json::array()},
               {"advice", advice}};
  for (const SweepRow& row : report.rows) {
    Json one;
    for (size_t i = 0; i < report.parameters.size(); ++i)
      one["setting"][report.parameters[i].name] = row.setting[i];
    one["error_mm"] = json_value(row.error_mm);
    one["error_sd_mm"] = json_value(row.error_sd_mm);
    one["lost_share"] = row.lost_share;
    one["seconds_per_frame"] = row.seconds_per_frame;
    one["cpu_seconds_per_frame"] = row.cpu_seconds_per_frame;
    one["frames_per_second"] = row.frames_per_second();
    one["holds"] = row.holds;
    one["on_front"] = row.on_front;
    one["runs"] = Json::array();
    for (const SweepRun& run : row.runs)
      one["runs"].push_back({{"seed", run.seed},
                             {"found", run.found},
                             {"error_mm", json_value(run.error_mm)},
                             {"lost_share", run.lost_share},
                             {"seconds_per_frame", run.seconds_per_frame},
                             {"cpu_seconds_per_frame", run.cpu_seconds_per_frame}});
    root["settings"].push_back(std::move(one));
  }
  return root.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::string sweep_markdown(const SweepReport& report, const std::vector<std::string>& advice) {
  std::string text = fmt::format(
      "# Speed and accuracy: {}\n\n{}\n{}\n{}\n"
      "| setting | error, mm | ± | lost, % | ms/frame | CPU ms | frames/s | |\n"
      "|---|---:|---:|---:|---:|---:|---:|---|\n",
      report.scene, errors_are(report), times_are(report),
      report.interrupted ? "Interrupted: not all runs are done; run again to go on.\n" : "");
  for (const SweepRow& row : report.rows)
    text += fmt::format("| {} | {} | {} | {:.1f} | {:.1f} | {:.1f} | {:.3g} | {} |\n",
                        name_of(report, row), number(row.error_mm, 1), number(row.error_sd_mm, 1),
                        kPerHundred * row.lost_share, kMilliseconds * row.seconds_per_frame,
                        kMilliseconds * row.cpu_seconds_per_frame, row.frames_per_second(),
                        row.on_front ? "front"
                        : row.holds  ? ""
                                     : "lost");
  text +=
      "\n`front`: nothing is both faster and more accurate. `lost`: a seed did not find the "
      "subject, or lost them for more than the quality check allows.\n\n";
  for (const std::string& sentence : advice) text += fmt::format("- {}\n", sentence);
  return text;
}

Outputs sweep_outputs(const SweepJob& job) {
  Outputs out{job.output,
              "sweep",
              {"sweep.csv", "sweep.json", "sweep.md", "sweep.svg"},
              files_of(job.scene),
              ""};
  out.inputs.push_back(job.truth);
  return out;
}

void write_sweep(const SweepReport& report, const std::vector<std::string>& advice,
                 const SweepJob& job) {
  std::vector<TradePoint> points;
  for (const SweepRow& row : report.rows)
    points.push_back({name_of(report, row), row.frames_per_second(), row.error_mm, row.error_sd_mm,
                      row.holds, row.on_front});
  const ResultFolder folder(sweep_outputs(job), true);
  folder.write("sweep.csv", sweep_csv(report));
  folder.write("sweep.json", sweep_json(report, advice));
  folder.write("sweep.md", sweep_markdown(report, advice));
  folder.write("sweep.svg",
               trade_plot_svg("Speed and accuracy: " + report.scene, report.error_is, points));
}

}  // namespace jobs
}  // namespace walktrack
