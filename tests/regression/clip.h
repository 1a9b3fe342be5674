// Real clips of the regression suite: what is watched in them beside what `evaluate` measures:
// where toes land, that people who stand take no step, that nobody walks where nobody does, and
// what a run says of itself.
#pragma once

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string_view>
#include <vector>

#include <Eigen/Core>
#include <nlohmann/json_fwd.hpp>

#include "body/motion.h"
#include "jobs/track/track.h"
#include "tests/regression/bands.h"

namespace walktrack {

struct Frames {
  int first, last;  // of the video, inclusive
};

// Paths are below ../shared/data, which may not be there.
struct Clip {
  std::string_view scene;
  std::string_view truth = {};         // empty: nobody walks
  std::optional<Frames> part = {};     // of the video; otherwise what the scene says
  std::optional<Frames> walking = {};  // before and after it they stand; otherwise always
};

std::filesystem::path file_of(std::string_view below_shared_data);
bool is_there(const Clip& clip);

// A toe that lands: toe_plants.csv.
struct Landing {
  Side side;
  double time;            // s after the first frame of a part
  Eigen::Vector2d place;  // m, of its tip
};

// Whether a file holds landings, and those of them after `first_frame`.
bool holds_landings(std::string_view truth);
std::vector<Landing> read_landings(const std::filesystem::path& file, int first_frame, double rate);

// What a run of a clip says of itself.
struct ClipRun {
  double rate = 0;               // Hz
  bool passed = false;           // all quality checks, exit code 0
  size_t steps = 0;              // in its gait
  double tracked_share = 0;      // of all frames
  double first_tracked = 0;      // s; NaN: none
  std::vector<double> standing;  // probability, by frame; NaN where nothing is tracked
};
ClipRun clip_run(const TrackOutcome& outcome, const nlohmann::json& run);

struct ClipFacts {
  bool walks = true;
  std::vector<Landing> landings;          // none: the truth is something else
  double sets_off = 0, stands_again = 0;  // s; equal: never stands
  ClipRun run;
};
ClipFacts facts_of(const Clip& clip, int first_frame, ClipRun run);

// As watched_figures() calls them. A toe is measured 6 to 13 frames after it has landed.
FigureValues clip_figures(const ClipFacts& facts, const Motion& estimate);

}  // namespace walktrack
