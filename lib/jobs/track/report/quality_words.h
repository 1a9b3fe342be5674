// The name of each quality measure, its meaning, and advice, for the readers of a report.
#pragma once

#include <span>
#include <string_view>

#include "io/archive/run_record.h"

namespace walktrack {
inline namespace jobs {

struct QualityWords {
  std::string_view name, what, unit;
  int digits;                // after the point
  std::string_view meaning;  // one sentence
  std::string_view advice;   // what to do when the check fails; empty where none can fail
};

// Every measure there is, in the order in which they are shown.
std::span<const QualityWords> quality_words();

// A measure of that name with its words, without a limit. std::out_of_range for an unknown name.
QualityMeasure quality_measure(std::string_view name, double value);

}  // namespace jobs
}  // namespace walktrack
