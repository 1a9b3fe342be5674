// report.html: one page that shows a motion that was tracked or analysed, made from the motion and
// from its tables.
//
// It contains the overlay videos, an interactive 3-D view of the figure, curves over the gait cycle
// beside a published normal range, events, diagnostics of the filter, quality checks, settings and
// run.json itself. Positions in it are in the library's world axes.
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
  std::filesystem::path source;  // the scene or the motion, for the title
  const AnalysedMotion& analysed;
  const JointUncertainty& uncertainty;   // for each row; or empty
  std::span<const SceneCamera> cameras;  // may be empty
  std::string run_json;
  std::vector<ReportClip> clips;  // overlay videos that have been written
};

// Writes report.html into the folder, with the tables that exist; returns its path.
std::filesystem::path write_report(const ResultFolder& folder, const ReportInput& input);

}  // namespace jobs
}  // namespace walktrack
