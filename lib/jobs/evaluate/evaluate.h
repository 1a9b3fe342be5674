// `walktrack evaluate`: compares estimates with a truth, as one list of named numbers for each
// estimate.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

#include "body/motion.h"
#include "io/drawing/error_plot.h"
#include "kinetics/force_error.h"
#include "metrics/references.h"
#include "metrics/statistics/coverage.h"

namespace walktrack {
inline namespace jobs {

// A truth is recognised by its header:
//   t,pelvis_x,…                             joints (joints.csv)
//   stance,side,on_frame,off_frame,x_m       foot plants; first and last frames, inclusive
//   t,x,y                                    ground points
//   frame,…,RHip_x,…                         key points of Pose2Sim; only joints of the body
//                                            model are used
using Truth = std::variant<Motion, std::vector<FootPlant>, GroundPoints>;

// `frame_rate` converts frames to seconds; files with times do not need it. InputError for any
// other header, naming it.
Truth read_truth(const std::filesystem::path& path, std::optional<double> frame_rate);

struct Figure {
  std::string key;    // with its unit, e.g. "joint_error_mean_mm"
  std::string label;  // its description
  double value;       // NaN = unknown
  int decimals;
  bool detail = false;  // not in the text table
};

// All errors that this truth can tell about the estimate, in a fixed order of keys.
std::vector<Figure> figures(const Truth& truth, const Motion& estimate,
                            const std::optional<JointUncertainty>& uncertainty);

// Errors of ground reactions (kinetics/force_error.h).
std::vector<Figure> force_figures(const GroundForces& truth, const GroundForces& estimate);

struct EvaluatedEstimate {
  std::string name;
  std::vector<Figure> figures;
  std::optional<ErrorSeries> series;  // for a truth of joints
};

// Numbers by rows, estimates by columns; cells are empty if an estimate lacks the key.
std::string as_markdown(const std::string& truth_name, const std::vector<EvaluatedEstimate>& all);
std::string as_json(const std::string& truth_name, const std::vector<EvaluatedEstimate>& all);

// The errors as a plot (io/drawing/error_plot.h). UsageError for a truth without joints.
std::string as_svg(const std::string& truth_name, const std::vector<EvaluatedEstimate>& all);

struct EvaluateJob {
  std::filesystem::path truth;  // a kinetics.csv beside it is used as the truth of forces
  // joints.csv files, or result folders of `track` that contain one. An uncertainty.csv beside it
  // is used if the truth has joints, a kinetics.csv if there is a truth of forces.
  std::vector<std::filesystem::path> estimates;
  std::optional<std::filesystem::path> uncertainty;  // used instead, for a single estimate
  std::optional<double> frame_rate;  // Hz, of the truth's frames; otherwise the estimate's rate
};

std::vector<EvaluatedEstimate> evaluate(const EvaluateJob& job);

}  // namespace jobs
}  // namespace walktrack
