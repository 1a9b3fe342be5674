#include "jobs/compare/compare_tables.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "io/config/text.h"
#include "io/tables/table_notes.h"
#include "metrics/cycle_curve.h"

namespace walktrack {
inline namespace jobs {

namespace {

using Json = nlohmann::ordered_json;

Json numbers(std::span<const double> values) {
  Json out = Json::array();
  for (const double value : values) out.push_back(json_number(value));
  return out;
}

// Mean and SD over the curves at every percentage of the stride.
Json curve_json(const std::vector<std::vector<double>>& curves) {
  std::vector<double> mean, sd;
  for (size_t k = 0; k < kCyclePoints && !curves.empty(); ++k) {
    std::vector<double> column;
    for (const auto& curve : curves) column.push_back(curve[k]);
    const SampleSpread spread = sample_spread(column);
    mean.push_back(spread.mean);
    sd.push_back(spread.sd);
  }
  return {{"count", curves.size()}, {"mean", numbers(mean)}, {"sd", numbers(sd)}};
}

Json angles_json(const Sample& sample, const Sample* reference, const CompareJob& job) {
  Json out = Json::object();
  for (size_t i = 0; i < kComparedAngles.size(); ++i) {
    const auto curves = drawn_curves(sample, i, job.unit);
    Json one = curve_json(curves);
    const auto others = reference ? drawn_curves(*reference, i, job.unit) : curves;
    if (reference && !curves.empty() && !others.empty()) {
      const MeanDifference found =
          mean_difference(curves, others, kCompareLevel, job.draws, job.seed);
      one["difference"] = numbers(found.difference);
      one["low"] = numbers(found.low);
      one["high"] = numbers(found.high);
    }
    out[std::string(kComparedAngles[i].name)] = one;
  }
  return out;
}

Json parameters_json(const Sample& sample, const Sample* reference, const CompareJob& job) {
  Json out = Json::object();
  for (size_t i = 0; i < kComparedParameters.size(); ++i) {
    const auto values = drawn_values(sample, i, job.unit);
    Json one = {{"count", values.size()}, {"mean", nullptr}, {"sd", nullptr}};
    if (!values.empty()) {
      const SampleSpread spread = sample_spread(values);
      one["mean"] = json_number(spread.mean);
      one["sd"] = json_number(spread.sd);
    }
    if (reference && !values.empty() && !drawn_values(*reference, i, job.unit).empty()) {
      const ParameterDifference found = parameter_difference(sample, *reference, i, job);
      one["difference"] = json_number(found.difference);
      one["low"] = json_number(found.low);
      one["high"] = json_number(found.high);
      one["detectable"] = json_number(found.detectable);
      one["with_bands"] = found.with_bands;
      one["exceeds"] = found.exceeds();
    }
    out[std::string(kComparedParameters[i].name)] = one;
  }
  return out;
}

Json comparison_json(const Comparison& comparison, const CompareJob& job) {
  Json samples = Json::array();
  for (const Sample& sample : comparison.samples) {
    const Sample* reference = samples.empty() ? nullptr : &comparison.samples.front();
    samples.push_back({{"name", sample.name},
                       {"angles", angles_json(sample, reference, job)},
                       {"parameters", parameters_json(sample, reference, job)}});
  }
  return {{"side", comparison.side}, {"samples", samples}};
}

Json group_json(const ComparedGroup& group) {
  Json trials = Json::array();
  for (const ComparedTrial& trial : group.trials)
    trials.push_back({{"name", trial.name},
                      {"folder", trial.folder.generic_string()},
                      {"status", trial.status},
                      {"failed_checks", trial.failed},
                      {"strides",
                       {{"left", trial.sides[0].curves[0].size()},
                        {"right", trial.sides[1].curves[0].size()}}}});
  return {{"name", group.name}, {"trials", trials}};
}

std::string title_of(const std::vector<ComparedGroup>& groups) {
  std::string title;
  for (const ComparedGroup& group : groups)
    title += fmt::format("{}{}", title.empty() ? "" : ", ", group.name);
  return groups.size() == 1 ? title + ": left and right" : title;
}

std::string cell(const Json& object, const char* key) {
  const auto found = object.find(key);
  return found != object.end() && found->is_number() ? fmt::format("{}", found->get<double>()) : "";
}

std::string cell(const Json& object, const char* key, size_t index) {
  const auto found = object.find(key);
  if (found == object.end() || index >= found->size() || !found->at(index).is_number()) return "";
  return fmt::format("{}", found->at(index).get<double>());
}

}  // namespace

Json compare_json(const std::vector<ComparedGroup>& groups, const CompareJob& job) {
  Json out;
  out["format"] = "walktrack compare 1";
  out["title"] = title_of(groups);
  out["method"] = {{"unit", job.unit == CompareUnit::kStrides ? "strides" : "trials"},
                   {"draws", job.draws},
                   {"seed", job.seed},
                   {"level", kCompareLevel}};
  out["groups"] = Json::array();
  for (const ComparedGroup& group : groups) out["groups"].push_back(group_json(group));
  for (const ComparedAngle& angle : kComparedAngles)
    out["angles"].push_back({{"name", angle.name}, {"label", angle.label}});
  for (const ComparedParameter& parameter : kComparedParameters)
    out["parameters"].push_back({{"name", parameter.name},
                                 {"label", parameter.label},
                                 {"unit", parameter.unit},
                                 {"digits", parameter.digits}});
  for (const Comparison& comparison : comparisons_of(groups))
    out["comparisons"].push_back(comparison_json(comparison, job));
  return out;
}

std::string compare_parameters_csv(const Json& compared) {
  std::string text = "side,group,parameter,count,mean,sd,difference,low,high,detectable,exceeds\n";
  for (const Json& comparison : compared.at("comparisons"))
    for (const Json& sample : comparison.at("samples"))
      for (const auto& [name, one] : sample.at("parameters").items())
        text += fmt::format(
            "{},{},{},{},{},{},{},{},{},{},{}\n", comparison.at("side").get<std::string>(),
            csv_cell(sample.at("name").get<std::string>()), name, one.at("count").get<size_t>(),
            cell(one, "mean"), cell(one, "sd"), cell(one, "difference"), cell(one, "low"),
            cell(one, "high"), cell(one, "detectable"),
            one.contains("exceeds") ? (one.at("exceeds").get<bool>() ? "1" : "0") : "");
  return text;
}

std::string compare_curves_csv(const Json& compared) {
  std::string text = "side,group,angle,percent,mean_deg,sd_deg,difference_deg,low_deg,high_deg\n";
  for (const Json& comparison : compared.at("comparisons"))
    for (const Json& sample : comparison.at("samples"))
      for (const auto& [name, one] : sample.at("angles").items())
        for (size_t k = 0; k < one.at("mean").size(); ++k)
          text +=
              fmt::format("{},{},{},{},{},{},{},{},{}\n", comparison.at("side").get<std::string>(),
                          csv_cell(sample.at("name").get<std::string>()), name, k,
                          cell(one, "mean", k), cell(one, "sd", k), cell(one, "difference", k),
                          cell(one, "low", k), cell(one, "high", k));
  return text;
}

CompareOutcome count_differences(const Json& compared) {
  CompareOutcome out;
  for (const Json& sample : compared.at("comparisons").at(0).at("samples"))
    for (const Json& one : sample.at("parameters")) {
      if (!one.contains("detectable") || !one.at("detectable").is_number()) continue;
      ++out.compared;
      out.exceeding += one.at("exceeds").get<bool>();
    }
  return out;
}

}  // namespace jobs
}  // namespace walktrack
