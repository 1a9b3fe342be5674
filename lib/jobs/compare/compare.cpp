#include "jobs/compare/compare.h"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include "core/errors.h"
#include "core/version.h"
#include "io/archive/result_folder.h"
#include "io/drawing/report_page.h"
#include "jobs/compare/compare_tables.h"

namespace walktrack {
inline namespace jobs {

namespace fs = std::filesystem;

namespace {

constexpr const char *kPage = "compare.html", *kJson = "compare.json";
constexpr const char *kParameters = "compare_parameters.csv", *kCurves = "compare_curves.csv";

bool has_strides(const ComparedGroup& group) {
  return std::any_of(group.trials.begin(), group.trials.end(), [](const ComparedTrial& trial) {
    return !trial.sides[0].curves[0].empty() || !trial.sides[1].curves[0].empty();
  });
}

std::vector<ComparedGroup> read_groups(const CompareJob& job) {
  std::vector<ComparedGroup> groups;
  std::set<std::string> names;
  for (const CompareGroup& group : job.groups) {
    groups.push_back(read_group(group));
    if (!names.insert(groups.back().name).second)
      throw UsageError(
          fmt::format("found two groups of the name '{0}', allowed: one; say "
                      "NAME={1} for another name",
                      groups.back().name, group.places.front().string()));
    if (!has_strides(groups.back()))
      throw InputError(describe({group.places.front().string(), 0, ""},
                                "no whole stride, from a heel strike to the next of the same foot",
                                "a walk of three steps or more"));
  }
  return groups;
}

Outputs outputs_of(const CompareJob& job) {
  Outputs outputs{job.output, "compare", {kPage, kParameters, kCurves, kJson}, {}, kJson};
  for (const CompareGroup& group : job.groups)
    outputs.inputs.insert(outputs.inputs.end(), group.places.begin(), group.places.end());
  return outputs;
}

}  // namespace

CompareGroup compare_group(const std::string& word) {
  std::error_code ignored;
  const size_t equals = word.find('=');
  if (equals == std::string::npos || fs::exists(word, ignored)) return {"", {word}};
  CompareGroup group{word.substr(0, equals), {}};
  for (size_t from = equals + 1; from <= word.size();) {
    const size_t comma = std::min(word.find(',', from), word.size());
    if (comma > from) group.places.emplace_back(word.substr(from, comma - from));
    from = comma + 1;
  }
  if (group.name.empty() || group.places.empty())
    throw UsageError(fmt::format("found '{}', allowed: a folder, or NAME=FOLDER,FOLDER", word));
  return group;
}

CompareOutcome compare(const CompareJob& job) {
  const std::vector<ComparedGroup> groups = read_groups(job);
  const ResultFolder folder(outputs_of(job), job.overwrite);
  nlohmann::ordered_json compared = compare_json(groups, job);
  compared["program"] = build_facts().version;
  const auto text = [&](int indent) {
    return compared.dump(indent, ' ', false, nlohmann::ordered_json::error_handler_t::replace);
  };
  folder.write(kParameters, compare_parameters_csv(compared));
  folder.write(kCurves, compare_curves_csv(compared));
  write_report_page(folder.file(kPage), {compared["title"], text(-1), {}}, compare_template());
  folder.write(kJson, text(1) + "\n");
  CompareOutcome outcome = count_differences(compared);
  outcome.look_at = folder.file(kPage);
  return outcome;
}

}  // namespace jobs
}  // namespace walktrack
