#include "jobs/track/results/motion_tables.h"

#include <algorithm>
#include <array>

#include "io/c3d/c3d_file.h"
#include "io/figure/bvh_file.h"
#include "io/figure/glb_file.h"
#include "io/tables/gait_file.h"
#include "io/tables/kinetics_file.h"
#include "io/tables/opensim.h"
#include "kinetics/gait_contacts.h"

namespace walktrack {
inline namespace jobs {

namespace {

void write_angles(const AnalysedMotion& analysed, const ResultFolder& folder) {
  folder.write("joints.trc", trc_from_motion(analysed.motion, analysed.rate, "joints.trc"));
  folder.write("angles.csv", joint_angles_csv(analysed.angles));
  std::vector<double> times;
  std::vector<Pose> poses;
  for (const AngleRow& row : analysed.angles) {
    if (!row.pose) continue;
    times.push_back(row.time);
    poses.push_back(*row.pose);
  }
  if (!times.empty())
    folder.write("angles.mot",
                 mot_from_poses(times, poses, body_lengths(analysed.subject), "angles"));
}

void write_c3d(const AnalysedMotion& analysed, const Gait& gait, const Kinetics& forces,
               const ResultFolder& folder) {
  if (analysed.motion.time.empty()) return;
  const bool any = std::any_of(forces.frames.begin(), forces.frames.end(),
                               [](const KineticsFrame& frame) { return frame.known; });
  folder.write("joints.c3d", c3d_from_motion({analysed.motion, analysed.rate, analysed.angles,
                                              gait.events, any ? &forces : nullptr}));
}

void write_figure(const AnalysedMotion& analysed, const ResultFolder& folder) {
  const AnimatedFigure figure = animated_figure(analysed.motion, body_lengths(analysed.subject));
  if (!figure.any_frame()) return;
  folder.write("figure.bvh", bvh_from_figure(figure, analysed.rate));
  folder.write("figure.glb", glb_from_figure(figure, analysed.subject));
}

}  // namespace

std::vector<std::string> motion_table_files() {
  return {"joints.trc",   "joints.c3d",          "figure.bvh",        "figure.glb",
          "angles.csv",   "angles.mot",          "gait.json",         "gait.csv",
          "kinetics.csv", "ground_reaction.mot", "joint_moments.sto", "tables.json"};
}

TableTotals write_motion_tables(const AnalysedMotion& analysed, const KineticsConfig& config,
                                const ResultFolder& folder) {
  write_angles(analysed, folder);
  GaitTable gait = gait_table(analysed.motion, analysed.members, analysed.transfers);
  add_gait_error(analysed.figure_error, analysed.model_error, gait);
  folder.write("gait.json", gait_json(gait));
  folder.write("gait.csv", gait_csv(gait));
  const Gait events = gait_from_motion(analysed.motion);
  const auto contacts = foot_contacts(events);
  const auto forces = [&](const Motion& motion) {
    return kinetics_of(motion, contacts, analysed.subject, analysed.gravity, config);
  };
  const Kinetics result = forces(analysed.motion);
  write_c3d(analysed, events, result, folder);
  write_figure(analysed, folder);
  const double weight = analysed.subject.mass * analysed.gravity.norm();
  KineticsBands bands(analysed.world, analysed.model_error * kTrackedLoadError * weight);
  for (size_t m = 0; m < analysed.members.size; ++m) bands.add(forces(analysed.members.member(m)));
  folder.write("kinetics.csv", kinetics_csv(result, bands, analysed.world));
  folder.write("tables.json",
               tables_json(std::array{joint_angles_notes(analysed.rate), gait_notes(),
                                      kinetics_notes(result, analysed.subject, config)}));
  folder.write("ground_reaction.mot", mot_from_ground_reactions(result));
  folder.write("joint_moments.sto", sto_from_joint_moments(result));
  return {result.totals, walk_summary(gait)};
}

}  // namespace jobs
}  // namespace walktrack
