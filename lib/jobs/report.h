// report.html: one page to look at and send on, made of what tracking found.
//
// It holds the overlay films, an interactive view of the figure in space, curves over the gait
// cycle beside a published normal range, events, what the filter says of itself, quality gates,
// settings and run.json itself. Positions in it are in the library's world axes.
#pragma once

#include <string>
#include <vector>

#include "io/report_page.h"
#include "io/result_folder.h"
#include "io/scene.h"
#include "jobs/track_results.h"

namespace walktrack {

struct ReportInput {
  const Scene& scene;
  const TrackedFrames& frames;
  std::string run_json;
  std::vector<ReportClip> clips;  // overlay films, written
};

// Writes report.html into the folder, with the gait.json that is there; returns its path.
std::filesystem::path write_report(const ResultFolder& folder, const ReportInput& input);

}  // namespace walktrack
