// compare.json and the tables made from it.
//
// compare.json
//   format       "walktrack compare 1"
//   title        "before, after"
//   method       {unit: "strides" | "trials", draws, seed, level}
//   groups       [{name, trials: [{name, folder, status, failed_checks, strides: {left, right}}]}]
//   angles       [{name, label}], parameters [{name, label, unit, digits}]
//   comparisons  [{side: "both" | "left" | "right" | "", samples: [sample, ...]}], the first sample
//                the one that others are compared with; side is "" where the samples are the sides
//   sample       {name, angles: {NAME: {count, mean: [101], sd: [101], difference, low, high:
//   [101]}},
//                parameters: {NAME: {count, mean, sd, difference, low, high, detectable,
//                with_bands, exceeds}}}; difference and what follows only after the first sample,
//                and null where unknown
// compare_parameters.csv, compare_curves.csv: the same, a row for each number.
#pragma once

#include <string>
#include <vector>

#include <nlohmann/json_fwd.hpp>

#include "jobs/compare/compare_figures.h"

namespace walktrack {
inline namespace jobs {

nlohmann::ordered_json compare_json(const std::vector<ComparedGroup>& groups,
                                    const CompareJob& job);

// The tables, from that JSON.
std::string compare_parameters_csv(const nlohmann::ordered_json& compared);
std::string compare_curves_csv(const nlohmann::ordered_json& compared);
CompareOutcome count_differences(const nlohmann::ordered_json& compared);

}  // namespace jobs
}  // namespace walktrack
