// report.html: one page that shows a motion that was tracked or analysed, made from the motion and
// from its tables.
//
// It holds the overlay videos, an interactive view of the figure in space, curves over the gait
// cycle beside a published normal range, events, diagnostics of the filter, quality checks,
// settings and run.json itself. Positions in it are in the library's world axes.
#pragma once

#include <filesystem>
#include <span>
#include <string>
#include <vector>

#include "io/archive/result_folder.h"
#include "io/drawing/report_page.h"
#include "io/scene/scene.h"
#include "jobs/track/results/motion_tables.h"
#include "metrics/statistics/coverage.h"

namespace walktrack {
inline namespace jobs {

inline constexpr const char* kReportFile = "report.html";

struct ReportInput {
  std::filesystem::path source;  // the scene or the motion that it is about; for the title
  const AnalysedMotion& analysed;
  const JointUncertainty& uncertainty;   // row by row; or empty
  std::span<const SceneCamera> cameras;  // may be none
  std::string run_json;
  std::vector<ReportClip> clips;  // overlay videos, written
};

// Writes report.html into the folder, with the tables that are there; returns its path.
std::filesystem::path write_report(const ResultFolder& folder, const ReportInput& input);

}  // namespace jobs
}  // namespace walktrack
