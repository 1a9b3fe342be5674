#include "jobs/evaluate/analyse.h"

#include <array>
#include <cmath>
#include <fstream>
#include <map>
#include <numeric>
#include <sstream>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "core/conventions.h"
#include "core/errors.h"
#include "io/archive/files.h"
#include "io/archive/result_folder.h"
#include "io/tables/csv.h"
#include "tests/data_folders.h"
#include "tests/run_program.h"

namespace walktrack {
namespace {

namespace fs = std::filesystem;

class Analyse : public testing::Test {
 protected:
  AnalyseJob job(const fs::path& motion) const {
    AnalyseJob out;
    out.motion = motion;
    out.output = folder_;
    return out;
  }
  const TemporaryFolder temporary_;
  const fs::path folder_ = temporary_.path() / "analysed";
};

TEST_F(Analyse, WritesACompleteResult) {
  const AnalyseOutcome outcome = analyse(job(kDemo / "truth.csv"));
  EXPECT_GE(outcome.steps, 5u);
  for (const char* name : {"gait.json", "gait.csv", "angles.csv", "angles.mot", "joints.trc",
                           "joints.c3d", "figure.bvh", "figure.glb", "kinetics.csv",
                           "ground_reaction.mot", "joint_moments.sto", "tables.json"})
    EXPECT_TRUE(fs::exists(folder_ / name)) << name;
  EXPECT_TRUE(is_complete_result(folder_));
  const auto run = nlohmann::json::parse(read_text_file(folder_ / "run.json", size_t{1} << 20));
  // The demo's subject is 1.75 m high according to thighs and shanks.
  EXPECT_NEAR(run.at("numbers").at("height_m").get<double>(), 1.75, 0.01);
  EXPECT_EQ(run.at("notes").size(), 1u);  // the mass is not stated
  EXPECT_THROW(analyse(job(kDemo / "truth.csv")), UsageError);
}

TEST_F(Analyse, ForcesGoWithTheMass) {
  AnalyseJob light = job(kDemo / "truth.csv");
  light.mass = 35;
  analyse(light);
  const CsvTable table = read_csv(folder_ / "kinetics.csv");
  const size_t row = table.rows.size() / 2;
  const double half = table.number(table.rows[row], table.column("l_grf_z_n")) +
                      table.number(table.rows[row], table.column("r_grf_z_n"));
  light.mass = 70;
  light.overwrite = true;
  analyse(light);
  const CsvTable heavy = read_csv(folder_ / "kinetics.csv");
  const double whole = heavy.number(heavy.rows[row], heavy.column("l_grf_z_n")) +
                       heavy.number(heavy.rows[row], heavy.column("r_grf_z_n"));
  EXPECT_NEAR(whole, 2 * half, 1e-4);
}

// Joints that `track` wrote need its cut-off frequency, wherever they are analysed.
TEST_F(Analyse, ForcesOfATrackedFolderAreSmoothedAsTrackingDoes) {
  const fs::path tracked = temporary_.path() / "tracked";
  fs::create_directories(tracked);
  fs::copy_file(kDemo / "truth.csv", tracked / "joints.csv", fs::copy_options::overwrite_existing);
  const auto smoothed_below = [&](const fs::path& motion) {
    AnalyseJob one = job(motion);
    one.overwrite = true;
    analyse(one);
    const std::string text = read_text_file(folder_ / "tables.json", size_t{1} << 24);
    return nlohmann::json::parse(text).at("kinetics.csv").at("smoothed_below_hz").get<double>();
  };
  const KineticsConfig config;
  EXPECT_EQ(smoothed_below(tracked), config.cutoff_hz);
  for (const auto& [command, expected] :
       {std::pair{"track", config.tracked_cutoff_hz}, std::pair{"analyse", config.cutoff_hz}}) {
    write_file_atomically(tracked / "run.json", std::string(R"({"command": ")") + command + "\"}");
    EXPECT_EQ(smoothed_below(tracked), expected) << command;
    EXPECT_EQ(smoothed_below(tracked / "joints.csv"), expected) << command;
  }
  write_file_atomically(tracked / "run.json", "no JSON");
  EXPECT_EQ(smoothed_below(tracked), config.cutoff_hz);
}

// OpenSim storage files: columns by name.
std::map<std::string, std::vector<double>> read_storage(const fs::path& file) {
  std::ifstream in(file);
  std::string line;
  while (std::getline(in, line) && line.find("endheader") == std::string::npos) continue;
  std::getline(in, line);
  std::vector<std::string> names;
  std::istringstream header(line);
  for (std::string name; header >> name;) names.push_back(name);
  std::map<std::string, std::vector<double>> columns;
  while (std::getline(in, line)) {
    std::istringstream cells(line);
    double value = 0;
    for (const std::string& name : names)
      if (cells >> value) columns[name].push_back(value);
  }
  return columns;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) / static_cast<double>(values.size());
}

struct Agreement {
  double correlation, spread_deg;  // of the differences, about their mean
};

Agreement agreement(const std::vector<double>& a_deg, const std::vector<double>& b_rad) {
  const size_t n = std::min(a_deg.size(), b_rad.size());
  double a1 = 0, b1 = 0, aa = 0, bb = 0, ab = 0;
  for (size_t i = 0; i < n; ++i) {
    const double a = a_deg[i], b = deg_from_rad(b_rad[i]);
    a1 += a, b1 += b, aa += a * a, bb += b * b, ab += a * b;
  }
  const auto count = static_cast<double>(n);
  const double va = aa - a1 * a1 / count, vb = bb - b1 * b1 / count, c = ab - a1 * b1 / count;
  return {c / std::sqrt(va * vb), std::sqrt((va + vb - 2 * c) / count)};
}

// The same laboratory trials by OpenSim's own inverse kinematics, with the same names and signs.
// Offsets of angles are not compared: OpenSim takes the pelvis's tilt and the foot's zero from
// markers. The height of the pelvis's origin is that of OpenSim's scaled model, except for the
// effect of its tilt.
TEST_F(Analyse, AnglesGoAsOpenSimsInverseKinematicsDo) {
  const std::map<std::string, double> spread_deg{
      {"hip_flexion", 4}, {"knee_angle", 4}, {"ankle_angle", 5}};
  for (const std::string trial : {"opencapS4_walking1", "opencapS4_walkingTS1"}) {
    const fs::path mocap = kSharedData / "mocap" / (trial + ".csv"),
                   ik = kSharedData / "grf" / (trial + "_ik.mot");
    if (!fs::exists(mocap) || !fs::exists(ik)) GTEST_SKIP() << ik << " is absent";
    AnalyseJob each = job(mocap);
    each.overwrite = true;
    analyse(each);
    const auto ours = read_storage(folder_ / "angles.mot"), theirs = read_storage(ik);
    EXPECT_NEAR(mean(ours.at("pelvis_ty")), mean(theirs.at("pelvis_ty")), 0.015) << trial;
    for (const auto& [joint, allowed] : spread_deg) {
      for (const char* side : {"_r", "_l"}) {
        const Agreement found = agreement(ours.at(joint + side), theirs.at(joint + side));
        EXPECT_GT(found.correlation, 0.9) << trial << " " << joint << side;
        EXPECT_LT(found.spread_deg, allowed) << trial << " " << joint << side;
      }
    }
    // Movements of a few degrees from joint centres with errors of a centimetre: only the sign is
    // tested.
    for (const char* name : {"pelvis_list", "hip_adduction_r", "hip_adduction_l"})
      EXPECT_GT(agreement(ours.at(name), theirs.at(name)).correlation, 0.7) << trial << " " << name;
  }
}

// The right and left foot are the plates' 1 and 2, y is their vertical axis. If they were swapped
// they would correlate negatively; the magnitude of the forces is tested by force_plates_test. The
// left foot is off the plates at first, so that a part of its curve is missing.
TEST_F(Analyse, GroundReactionsAreNamedAsTheForcePlatesAre) {
  for (const std::string trial : {"opencapS4_walking1", "opencapS4_walkingTS1"}) {
    const fs::path mocap = kSharedData / "mocap" / (trial + ".csv"),
                   plates = kSharedData / "grf" / (trial + ".mot");
    if (!fs::exists(mocap) || !fs::exists(plates)) GTEST_SKIP() << plates << " is absent";
    AnalyseJob each = job(mocap);
    each.overwrite = true;
    analyse(each);
    const auto ours = read_storage(folder_ / "ground_reaction.mot"), theirs = read_storage(plates);
    ASSERT_GT(ours.at("time").size(), 100u);
    const auto together = [&](const char* a, const char* b) {
      return agreement(ours.at(a), theirs.at(b)).correlation;
    };
    EXPECT_GT(together("ground_force_r_vy", "ground_force_1_vy"), 0.8) << trial;
    EXPECT_GT(together("ground_force_l_vy", "ground_force_2_vy"), 0.8) << trial;
  }
}

}  // namespace
}  // namespace walktrack
