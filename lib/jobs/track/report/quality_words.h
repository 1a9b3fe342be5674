// The name of each quality measure, its meaning, and advice, for the readers of a report.
#pragma once

#include <span>
#include <string_view>

#include "io/archive/run_record.h"

namespace walktrack {
inline namespace jobs {

struct QualityWords {
  std::string_view name, what, unit;
  int digits;                // number of decimals
  std::string_view meaning;  // one sentence
  std::string_view advice;   // advice if the check fails; empty if it cannot fail
};

// All measures, in the order in which they are shown.
std::span<const QualityWords> quality_words();

// The measure of that name with its texts, without a limit. std::out_of_range for an unknown name.
QualityMeasure quality_measure(std::string_view name, double value);

}  // namespace jobs
}  // namespace walktrack
